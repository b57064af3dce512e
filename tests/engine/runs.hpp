#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "engine/method_info.hpp"
#include "engine/simulation.hpp"

namespace taut::test {

/// Settings of a method on one thread.
inline Settings with_method(const std::string& method, Stepping stepping = Stepping::dual) {
  Settings settings;
  settings.method = method;
  settings.stepping = stepping;
  settings.threads = 1;
  return settings;
}

inline void make_steps(Simulation& simulation, long steps) {
  const long end = simulation.steps() + steps;
  while (simulation.steps() < end) simulation.advance_to(std::nextafter(simulation.time(), 1.0));
}

/// The state after `steps` steps.
inline Snapshot state_after(long steps, const Scene& scene, const Settings& settings) {
  const auto simulation = make_simulation(scene, settings);
  make_steps(*simulation, steps);
  return simulation->snapshot();
}

}  // namespace taut::test
