#pragma once

#include "engine/snapshot.hpp"

namespace taut {

/// Interpolates a run at time `t` between two successive steps.
/// Positions follow the parabola through both steps with the mean acceleration of the step, (v_after − v_before)/dt.
/// If x advances by the mean velocity, as in position Verlet, it is the cubic through positions and velocities. It
/// needs v at the same time offset from x at both steps. With θ = (t − before)/dt, its error is θ (1 − θ) (1 −
/// 2θ)/12 dt³ d³x/dt³, at most 0.008 dt³ d³x/dt³. Other time-dependent fields are linear.
Snapshot blend(const Snapshot& before, const Snapshot& after, double t);

}  // namespace taut
