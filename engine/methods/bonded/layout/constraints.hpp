#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// How the scene constrains a particle, as far as its bonds are concerned.
enum class Constraint : unsigned char {
  free,     // also particles that are driven for a part of the run, and driven particles that stand on a face
  pinned,   // does not move, but its body can turn about it: bonded like a free particle
  clamped,  // does not move
  driven    // has a prescribed velocity to the end of the run
};
using Constraints = std::vector<Constraint>;  // by id

/// Bonds end at the face of a rigid region (THEORY.md, Clamps).
inline bool is_rigid(Constraint c) { return c == Constraint::clamped || c == Constraint::driven; }

/// A pin is a constrained particle without others beside it in 2D, or one of a single row in 3D. As a clamp it would
/// resist a turn by about 0.02 E dp².
Constraints make_constraints(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
