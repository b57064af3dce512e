#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/simulation.hpp"

namespace taut {

struct CriticalStepSearch {
  int steps = 1000;         // duration of a trial, in default steps
  double tolerance = 1e-3;  // relative width of the bracket
};

struct CriticalStep {
  std::optional<double> stable;    // greatest found, s
  std::optional<double> unstable;  // least found, s
  double default_step = 0;         // s
  double covered = 0;              // least duration of a trial, s
  int trials = 0;
  bool interrupted = false;  // before reaching `tolerance`
};

/// Bisects over fixed steps with random initial velocities (THEORY.md). Throws the errors of make_simulation.
CriticalStep find_critical_step(
    const Scene& scene, const Settings& settings, const CriticalStepSearch& search = {},
    const std::function<bool(const CriticalStep&)>& goes_on = [](const CriticalStep&) { return true; });

}  // namespace taut
