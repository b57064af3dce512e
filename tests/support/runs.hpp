#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "engine/methods/catalogue.hpp"
#include "engine/simulation.hpp"
#include "engine/snapshot_blend.hpp"

namespace taut::test {

inline bool keeps_neighbors(const MethodInfo& method) {
  return std::ranges::find(method.contact_laws, ContactLaw::sph) == method.contact_laws.end();
}

inline bool supports(const MethodInfo& method, ContactLaw law) {
  return std::ranges::find(method.contact_laws, law) != method.contact_laws.end();
}

inline bool has_elements(const MethodInfo& method) { return method.formulation.element_order > 0; }

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

/// Interpolated over the step that reaches `t`.
inline Snapshot state_at(double t, Simulation& simulation) {
  simulation.advance(t, t);
  const Snapshot before = simulation.snapshot();
  simulation.advance_to(t);
  return blend(before, simulation.snapshot(), t);
}

inline Snapshot state_after(long steps, const Scene& scene, const Settings& settings) {
  const auto simulation = make_simulation(scene, settings);
  make_steps(*simulation, steps);
  return simulation->snapshot();
}

/// Value of the first probe, interpolated.
inline double value_at(const Series& series, double t) {
  const auto after = std::ranges::lower_bound(series.time, t) - series.time.begin();
  const double t0 = series.time[after - 1], t1 = series.time[after];
  const std::vector<double>& y = series.value[0];
  return y[after - 1] + (t - t0) / (t1 - t0) * (y[after] - y[after - 1]);
}

}  // namespace taut::test
