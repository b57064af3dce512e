#pragma once

#include "engine/snapshot.hpp"

namespace taut {

/// Interpolates a run at time `t` between successive steps. Positions follow the parabola with the mean acceleration
/// of the step. If x advances by the mean velocity (position Verlet), it is the cubic through positions and
/// velocities, provided v has the same time offset from x at both steps. Error: θ (1 − θ) (1 − 2θ)/12 dt³ d³x/dt³
/// with θ = (t − before)/dt, at most 0.008 dt³ d³x/dt³. Other time-dependent fields are linear; `after` supplies
/// constant ones and the step number.
Snapshot blend(const Snapshot& before, const Snapshot& after, double t);

}  // namespace taut
