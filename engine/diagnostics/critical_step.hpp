#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/simulation.hpp"

namespace taut {

struct CriticalStepSearch {
  int steps = 1000;         // of a trial, in default steps
  double tolerance = 1e-3;  // relative width of the bracket
};

struct CriticalStep {
  std::optional<double> stable;    // s; none: unstable down to 1/16 default step
  std::optional<double> unstable;  // s; none: stable up to 256 default steps
  double default_step = 0;         // s
  double covered = 0;              // s, shortest trial
  int trials = 0;
  bool interrupted = false;
};

/// Bisects over fixed steps. Trials cover `search.steps` default steps or the scene, whichever is shorter, but at
/// least 300 steps. Particles get the same random velocities up to 1e-6 c0 in all trials. A trial is unstable if a
/// velocity or energy is not finite, a particle is faster than 10 c0, or kinetic and strain energy exceed 100 times
/// the given energy (start and work) plus the energy of speeds of 1e-3 c0: near the limit the energy of a stable
/// leap-frog oscillates. Tearing is allowed, as in [Zhang2020] Fig. 18.
/// The search ends when `goes_on` returns false. Throws the same errors as make_simulation.
CriticalStep find_critical_step(
    const Scene& scene, const Settings& settings, const CriticalStepSearch& search = {},
    const std::function<bool(const CriticalStep&)>& goes_on = [](const CriticalStep&) { return true; });

}  // namespace taut
