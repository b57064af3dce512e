#pragma once

#include "engine/snapshot.hpp"

namespace taut {

/// Interpolates between two successive steps. Positions follow the parabola through both steps with the mean
/// acceleration of the step; other fields vary linearly. Requires that v lags x by the same time at both steps.
Snapshot blend(const Snapshot& before, const Snapshot& after, double t);

}  // namespace taut
