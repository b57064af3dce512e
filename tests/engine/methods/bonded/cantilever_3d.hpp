#pragma once

#include <doctest/doctest.h>

#include "engine/diagnostics/measures.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace taut::test {

inline Settings with_damping(double damping) {
  Settings settings = with_method("oenog");
  settings.constants["damping"] = damping;
  return settings;
}

inline Scene square_cantilever(int across) {
  const double L = 0.2, H = 0.02;
  Scene scene;
  scene.name = "square-cantilever";
  scene.dim = 3;
  scene.spacing = H / across;
  scene.materials = {plate_elastic()};
  Body beam;
  beam.name = "beam";
  beam.shapes = {Box{{-3 * scene.spacing, -H / 2, -H / 2}, {L, H / 2, H / 2}}};
  beam.clamped = [](const Point& x) { return x[0] < 0 ? 1.0 : 0.0; };
  scene.bodies = {beam};
  scene.probes = {make_probe("tip", Probe::Kind::displacement)};
  scene.probes[0].at = {L, 0, 0};
  scene.probes[0].axis = 1;
  Measure period;
  period.kind = "period";
  period.probes = {"tip"};
  scene.measures = {period};
  return scene;
}
inline Scene bending_cantilever(int across) {
  Scene scene = square_cantilever(across);
  scene.bodies[0].velocity[1] = oscillating_plate(0.001, across).bodies[0].velocity[1];
  return scene;
}

inline double error_of_period(const Scene& scene, double reference) {
  const auto simulation = make_simulation(scene, with_damping(0));
  simulation->advance_to(1.15 * reference);
  const auto result = measure(scene, simulation->series(), "neo_hookean");
  REQUIRE(result[0].value);
  return *result[0].value / reference - 1;
}

}  // namespace taut::test
