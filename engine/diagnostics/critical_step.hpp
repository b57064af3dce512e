#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/simulation.hpp"

namespace taut {

/// Parameters of the search for the largest stable time step.
struct CriticalStepSearch {
  int steps = 1000;         // duration of each trial in default steps
  double tolerance = 1e-3;  // relative width of the final bracket
};

/// Largest stable and smallest unstable time step of a scene.
struct CriticalStep {
  std::optional<double> stable;    // s; none: unstable down to 1/16 of the default step
  std::optional<double> unstable;  // s; none: stable up to 256 times the default step
  double default_step = 0;         // s, first step by the method's own rule
  double covered = 0;              // s, least duration of a trial
  int trials = 0;
  bool interrupted = false;  // before the bracket was narrow enough
};

/// Bisects over fixed time steps. Each trial starts anew and covers `search.steps` default steps or the scene's
/// duration, whichever is shorter, but at least 300 steps of its own. To excite unstable modes, particles get random
/// velocities up to 1e-6 c0 along each axis, equal in all trials. A trial is unstable if
/// - a velocity or energy is not finite, or a particle is faster than the solver allows (10 c0),
/// - kinetic and strain energy exceed 100 times the given energy (start and work) plus the energy of all particles at
///   1e-3 c0. The limit is high because below the stability limit the energy of a leap-frog scheme oscillates.
/// Tearing is not unstable in this sense, as in [Zhang2020] Fig. 18.
/// `goes_on` is called regularly; false ends the search. Throws as make_simulation.
CriticalStep find_critical_step(
    const Scene& scene, const Settings& settings, const CriticalStepSearch& search = {},
    const std::function<bool(const CriticalStep&)>& goes_on = [](const CriticalStep&) { return true; });

}  // namespace taut
