#pragma once

#include "engine/snapshot.hpp"

namespace taut {

/// A run at time `t` between two of its steps, `before` and `after`, or at one of them.
///
/// Positions go along the parabola through both whose acceleration is the change of the velocity over the
/// step. Where x follows the mean of both velocities, as in position Verlet, that is the cubic through places
/// and velocities; it needs v as far from x in time at both steps, not at one time with it. On a smooth path
/// it is off by θ (1 − θ) (1 − 2θ)/12 dt³ d³x/dt³ with θ = (t − before)/dt, at most 0.008 dt³ d³x/dt³. All
/// else that goes on from step to step is linear in t; what does not is that of `after`, as is the number of
/// the step.
Snapshot blend(const Snapshot& before, const Snapshot& after, double t);

}  // namespace taut
