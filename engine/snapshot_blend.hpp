#pragma once

#include "engine/snapshot.hpp"

namespace taut {

/// Interpolates a run at time `t` between two successive steps. Positions follow the parabola through both steps with
/// the mean acceleration of the step; on a smooth path the error is at most 0.008 dt³ d³x/dt³. Requires that v lags x
/// by the same time at both steps. Other time-dependent fields are interpolated linearly.
Snapshot blend(const Snapshot& before, const Snapshot& after, double t);

}  // namespace taut
