#include "engine/diagnostics/critical_step.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

constexpr double kick = 1e-6;                   // of c0
constexpr double allowed_speed = 1e-3;          // of c0; the energy of this speed is added to the limit
constexpr double allowed_energy = 100;          // of the received energy
constexpr int stretch = 16;                     // steps between checks
constexpr int least_steps = 300;                // enough to detect a step 1e-4 above the leap-frog limit
constexpr double most = 256, least = 1.0 / 16;  // of the default step

/// Hash of the position, from −1 to 1 (SplitMix64).
double noise(const Point& x, std::uint64_t component) {
  std::uint64_t bits = component;
  for (const double coordinate : x) {
    bits += std::bit_cast<std::uint64_t>(coordinate) + 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    bits ^= bits >> 31;
  }
  return 2 * static_cast<double>(bits) / static_cast<double>(std::numeric_limits<std::uint64_t>::max()) - 1;
}

double greatest_sound_speed(const Scene& scene) {
  double c0 = 0;
  for (const Material& material : scene.materials) c0 = std::max(c0, material.sound_speed());
  return c0;
}

Scene shaken(Scene scene) {
  const double speed = kick * greatest_sound_speed(scene);
  for (Body& body : scene.bodies)
    for (std::size_t k = 0; k < static_cast<std::size_t>(scene.dim); ++k)
      body.velocity[k] = [speed, k, v = body.velocity[k]](const Point& x) {
        return (v ? v(x) : 0) + speed * noise(x, k);
      };
  return scene;
}

class EnergyLimit {
 public:
  EnergyLimit(const Scene& scene, const Simulation& start) {
    const Snapshot& now = start.snapshot();
    double mass = 0;
    for (const double m : now.m) mass += m;
    const double speed = allowed_speed * greatest_sound_speed(scene);
    noise_ = 0.5 * mass * speed * speed;
    const Balance sums = balance(now, scene);
    start_ = given_ = sums.kinetic + sums.strain;
  }
  bool exceeded(const Balance& sums) {
    given_ = std::max(given_, start_ + sums.work);
    return !(sums.kinetic + sums.strain <= allowed_energy * given_ + noise_) ||
           !std::isfinite(sums.angular_scale);
  }

 private:
  double noise_ = 0, start_ = 0, given_ = 0;  // J
};

class Bisection {
 public:
  Bisection(const Scene& scene, const Settings& settings, const CriticalStepSearch& search,
            const std::function<bool(const CriticalStep&)>& goes_on)
      : scene_(shaken(scene)), settings_(settings), tolerance_(search.tolerance), goes_on_(goes_on) {
    settings_.step = 0;
    const auto simulation = make_simulation(scene_, settings_);
    simulation->advance_to(std::numeric_limits<double>::min());
    result_.default_step = simulation->time();
    result_.covered = std::min(search.steps * result_.default_step, scene.until);
  }

  CriticalStep run() {
    for (double share = 1; open(share); share *= result_.stable ? 2 : 0.5) try_step(share);
    while (!result_.interrupted && result_.stable && result_.unstable && width() > tolerance_)
      try_step(0.5 * (*result_.stable + *result_.unstable) / result_.default_step);
    return result_;
  }

 private:
  bool open(double share) const {
    return !result_.interrupted && !(result_.stable && result_.unstable) && share <= most && share >= least;
  }
  double width() const { return 1 - *result_.stable / *result_.unstable; }

  void try_step(double share) {
    settings_.step = share * result_.default_step;
    const bool stable = covers();
    if (result_.interrupted) return;
    ++result_.trials;
    (stable ? result_.stable : result_.unstable) = settings_.step;
  }

  bool covers() {
    try {
      const auto simulation = make_simulation(scene_, settings_);
      EnergyLimit limit(scene_, *simulation);
      const double end = std::max(result_.covered, least_steps * settings_.step);
      while (simulation->time() < end) {
        result_.interrupted = !goes_on_(result_);
        if (result_.interrupted) return false;
        simulation->advance_to(std::min(simulation->time() + (stretch - 0.5) * settings_.step, end));
        if (limit.exceeded(balance(simulation->snapshot(), scene_))) return false;
      }
      return true;
    } catch (const NumericalError&) {
      return false;
    }
  }

  Scene scene_;
  Settings settings_;
  double tolerance_;
  const std::function<bool(const CriticalStep&)>& goes_on_;
  CriticalStep result_;
};

}  // namespace

CriticalStep find_critical_step(const Scene& scene, const Settings& settings,
                                const CriticalStepSearch& search,
                                const std::function<bool(const CriticalStep&)>& goes_on) {
  return Bisection(scene, settings, search, goes_on).run();
}

}  // namespace taut
