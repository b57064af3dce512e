#pragma once

#include <cmath>
#include <numbers>

#include "engine/scene/scene.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/round_shapes.hpp"

namespace taut::test {

inline Expression constant(double value) {
  return [value](const Point&) { return value; };
}

inline Probe make_probe(const char* name, Probe::Kind kind, std::vector<int> bodies = {0}) {
  Probe probe;
  probe.name = name;
  probe.kind = kind;
  probe.bodies = std::move(bodies);
  return probe;
}

inline Material ring_rubber() { return {"rubber", /*ρ0*/ 1200, /*E*/ 1e7, /*ν*/ 0.4}; }
inline Material ball_rubber() { return {"rubber", /*ρ0*/ 1200, /*E*/ 1e7, /*ν*/ 0.49}; }
inline Material plate_elastic() { return {"elastic", /*ρ0*/ 1000, /*E*/ 2e6, /*ν*/ 0.3975}; }

/// [Zhang2024] §6.3; `v0` in sound speeds.
inline Scene colliding_rings(double v0 = 0.06, double dp = 0.001) {
  Scene scene;
  scene.name = "colliding-rings";
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  const double inner = 0.03, outer = 0.04, offset = 0.045, v = v0 * ring_rubber().sound_speed();
  for (const double side : {-1.0, 1.0}) {
    Body ring;
    ring.name = side < 0 ? "left" : "right";
    ring.shapes = {Ring{{side * offset, 0, 0}, inner, outer}};
    ring.velocity[0] = constant(-side * v);
    ring.mirror[0] = side > 0;
    scene.bodies.push_back(ring);
  }
  return scene;
}

/// [Zhang2024] §6.1, Eq. 28–29; `vf` in sound speeds, `across` particles over the thickness.
inline Scene oscillating_plate(double vf, int across = 10) {
  const double L = 0.2, H = 0.02, kL = 1.875;
  Scene scene;
  scene.name = "oscillating-plate";
  scene.spacing = H / across;
  scene.materials = {plate_elastic()};
  const double grip = 4 * scene.spacing, clamp = 0.06 + grip;
  Body plate;
  plate.name = "plate";
  plate.shapes = {Box{{0, -H / 2, 0}, {L, H / 2, 0}}, Box{{-clamp, -H / 2 - grip, 0}, {0, H / 2 + grip, 0}}};
  plate.clamped = [](const Point& x) { return x[0] < 0 ? 1.0 : 0.0; };
  const auto f = [=](double x) {
    const double kx = kL * x / L;
    return (std::sin(kL) + std::sinh(kL)) * (std::cos(kx) - std::cosh(kx)) -
           (std::cos(kL) + std::cosh(kL)) * (std::sin(kx) - std::sinh(kx));
  };
  const double tip_speed = vf * plate_elastic().sound_speed();
  plate.velocity[1] = [=](const Point& x) { return tip_speed * f(x[0]) / f(L); };
  scene.bodies = {plate};
  scene.probes = {make_probe("tip", Probe::Kind::displacement)};
  scene.probes[0].at = {L, 0, 0};
  scene.probes[0].axis = 1;
  return scene;
}

/// [Zhang2024] §6.5; `v0` in sound speeds.
inline Scene ball_plate(double v0 = 0.02, double dp = 0.0025) {
  const double length = 0.5, thickness = 0.02, height = 0.1, radius = 0.05, fixed = 4 * dp;
  Scene scene;
  scene.name = "ball-plate";
  scene.spacing = dp;
  scene.materials = {ball_rubber()};
  const auto stretch = [=](double from, double to) {
    return Box{{from, -thickness / 2, 0}, {to, thickness / 2, 0}};
  };
  Body plate, ball;
  plate.name = "plate";
  plate.shapes = {stretch(-length / 2, length / 2), stretch(-length / 2 - fixed, -length / 2),
                  stretch(length / 2, length / 2 + fixed)};
  plate.clamped = [=](const Point& x) { return std::abs(x[0]) > length / 2 ? 1.0 : 0.0; };
  ball.name = "ball";
  ball.shapes = {Disc{{0, height, 0}, radius}};
  ball.velocity[1] = constant(-v0 * ball_rubber().sound_speed());
  scene.bodies = {plate, ball};
  return scene;
}

/// Smooth pattern from −1 to 1 whose axes are oblique to a lattice.
inline double shake(const Point& x, double wavelength) {
  const double k = 2 * std::numbers::pi / wavelength;
  return std::sin(k * (x[0] + 0.37 * x[1])) * std::cos(k * (0.61 * x[0] - x[1]) + 0.4);
}

inline Scene small_collision() {
  const double dp = 0.001, c0 = ring_rubber().sound_speed();
  Scene scene;
  scene.name = "small-collision";
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body ring, disc;
  ring.name = "ring";
  ring.shapes = {Ring{{-0.0081, 0, 0}, 0.004, 0.008}};
  ring.velocity[0] = [=](const Point& x) { return c0 * (0.1 + 0.02 * shake(x, 5 * dp)); };
  ring.velocity[1] = [=](const Point& x) { return c0 * 0.02 * shake(x, 7 * dp); };
  disc.name = "disc";
  disc.shapes = {Disc{{0.0071, 0.0013, 0}, 0.006}};
  disc.velocity[0] = [=](const Point& x) { return c0 * (-0.12 + 0.02 * shake(x, 6 * dp)); };
  disc.velocity[1] = [=](const Point& x) { return c0 * (0.03 + 0.02 * shake(x, 5 * dp)); };
  scene.bodies = {ring, disc};
  return scene;
}

inline Scene small_clamped_plate() {
  const double dp = 0.001, c0 = ring_rubber().sound_speed(), L = 0.016, H = 0.005;
  Scene scene;
  scene.name = "small-clamped-plate";
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body plate, disc;
  plate.name = "plate";
  plate.shapes = {Box{{0, -H / 2, 0}, {L, H / 2, 0}}, Box{{-4 * dp, -H / 2, 0}, {0, H / 2, 0}}};
  plate.clamped = [](const Point& x) { return x[0] < 0 ? 1.0 : 0.0; };
  plate.velocity[0] = [=](const Point& x) { return c0 * 0.02 * shake(x, 5 * dp); };
  plate.velocity[1] = [=](const Point& x) { return c0 * (0.1 * x[0] / L + 0.02 * shake(x, 7 * dp)); };
  disc.name = "disc";
  disc.shapes = {Disc{{0.0003, 0.0062, 0}, 0.003}};
  disc.velocity[1] = constant(-0.15 * c0);
  scene.bodies = {plate, disc};
  return scene;
}

/// `speed`: speed of the corners, in sound speeds.
inline Scene rotating_plate(double speed) {
  const double dp = 0.001, half = 0.01;
  Scene scene;
  scene.name = "rotating-plate";
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  const double omega = speed * ring_rubber().sound_speed() / (std::numbers::sqrt2 * half);
  Body plate;
  plate.name = "plate";
  plate.shapes = {Box{{-half, -half, 0}, {half, half, 0}}};
  plate.velocity[0] = [=](const Point& x) { return -omega * x[1]; };
  plate.velocity[1] = [=](const Point& x) { return omega * x[0]; };
  scene.bodies = {plate};
  return scene;
}

inline Scene small_solid_collision() {
  const double dp = 0.001, c0 = ring_rubber().sound_speed();
  Scene scene;
  scene.name = "small-solid-collision";
  scene.dim = 3;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body block, ball;
  block.name = "block";
  block.shapes = {Box{{-0.0041, -0.002, -0.002}, {-0.0001, 0.002, 0.002}}};
  block.velocity[0] = [=](const Point& x) { return c0 * (0.1 + 0.02 * shake(x, 5 * dp)); };
  block.velocity[1] = [=](const Point& x) { return c0 * (10 * x[2] + 0.02 * shake(x, 7 * dp)); };
  block.velocity[2] = [=](const Point& x) { return c0 * (-10 * x[1] + 0.02 * shake(x, 6 * dp)); };
  ball.name = "ball";
  ball.shapes = {Disc{{0.0032, 0.0009, -0.0006}, 0.0026}};
  ball.velocity[0] = [=](const Point& x) { return c0 * (-0.12 + 0.02 * shake(x, 6 * dp)); };
  ball.velocity[1] = [=](const Point& x) { return c0 * (0.03 + 20 * x[2]); };
  ball.velocity[2] = constant(-0.02 * c0);
  scene.bodies = {block, ball};
  return scene;
}

inline Scene small_clamped_block() {
  const double dp = 0.001, c0 = ring_rubber().sound_speed(), L = 0.006, H = 0.003;
  Scene scene;
  scene.name = "small-clamped-block";
  scene.dim = 3;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  Body block, ball;
  block.name = "block";
  block.shapes = {Box{{-3 * dp, -H / 2, -H / 2}, {L, H / 2, H / 2}}};
  block.clamped = [](const Point& x) { return x[0] < 0 ? 1.0 : 0.0; };
  block.velocity[0] = [=](const Point& x) { return c0 * 0.02 * shake(x, 5 * dp); };
  block.velocity[1] = [=](const Point& x) { return c0 * (0.1 * x[0] / L + 0.02 * shake(x, 7 * dp)); };
  block.velocity[2] = [=](const Point& x) { return c0 * 0.1 * x[0] * x[1] / (L * H); };
  ball.name = "ball";
  ball.shapes = {Disc{{0.0003, 0.0042, 0.0002}, 0.0021}};
  ball.velocity[1] = constant(-0.15 * c0);
  scene.bodies = {block, ball};
  return scene;
}

/// `share`: greatest offset along each axis, in spacings.
inline Scene jittered(Scene scene, double share) {
  scene.jitter = {share, 5};
  return scene;
}

}  // namespace taut::test
