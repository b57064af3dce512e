#pragma once

#include "engine/snapshot.hpp"

namespace taut {

/// Interpolates a run at time `t` from `before` to `after`, two successive steps.
///
/// Positions follow the parabola through both positions with the mean acceleration of the step. If x advances by the
/// mean of both velocities (position Verlet), this is the cubic through positions and velocities, provided v has the
/// same time offset from x at both steps. Error: θ (1 − θ) (1 − 2θ)/12 dt³ d³x/dt³ with θ = (t − before)/dt, at most
/// 0.008 dt³ d³x/dt³. Other time-dependent fields are linear in t. Constant fields and the step number are those of
/// `after`.
Snapshot blend(const Snapshot& before, const Snapshot& after, double t);

}  // namespace taut
