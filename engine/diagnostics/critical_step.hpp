#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/simulation.hpp"

namespace taut {

/// How the largest stable time step is looked for.
struct CriticalStepSearch {
  int steps = 1000;         // steps of the method's default size whose time each trial covers
  double tolerance = 1e-3;  // of the bracket around the step, as a share of it
};

/// The largest time step with which a scene is stable, and the least that is not.
struct CriticalStep {
  std::optional<double> stable;    // s; none: unstable down to 1/16 of the default step
  std::optional<double> unstable;  // s; none: stable up to 256 times the default step
  double default_step = 0;         // s, the first by the method's own rule
  double covered = 0;              // s, by each trial at least
  int trials = 0;
  bool interrupted = false;  // before the bracket was as narrow as asked for
};

/// Bisects over fixed time steps; what changes with the time step else is left as it is. Each trial starts
/// anew and covers the same time: `search.steps` default steps, or the scene up to its end where that is
/// sooner, but at least 300 steps of its own.
///
/// So that what could grow is there to grow, every particle starts with a small random velocity more: up to
/// 1e-6 c0 along each axis, the same in every trial. A trial is unstable once
/// - a velocity or an energy is not finite, or a particle is faster than the solver allows (10 c0),
/// - kinetic and strain energy exceed 100 times what was given (start and work), by more than what all
///   particles have at 1e-3 c0: 1000 times the random velocity. Below the limit the energy of a leap-frog
///   swings too, the more the nearer it is: twice, as the verdict of a run has it, would stop short of the
///   limit by some per cent.
/// A body that tears is not unstable in this sense: [Zhang2020] Fig. 18 waits for the explosion.
///
/// `goes_on` is asked between stretches of steps; false ends the search. Throws what make_simulation throws.
CriticalStep find_critical_step(
    const Scene& scene, const Settings& settings, const CriticalStepSearch& search = {},
    const std::function<bool(const CriticalStep&)>& goes_on = [](const CriticalStep&) { return true; });

}  // namespace taut
