#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Constraint of a particle by the scene, as far as its bonds are concerned.
enum class Constraint : unsigned char {
  free,     // also particles driven for part of the run, and driven particles on the face of a driven region
  pinned,   // does not move, but the body can rotate about it: bonded like a free particle
  clamped,  // does not move
  driven    // has a prescribed velocity until the end of the run
};
using Constraints = std::vector<Constraint>;  // by id

/// Returns whether the particle belongs to a rigid region, at whose face bonds end (THEORY.md, Clamps).
inline bool is_rigid(Constraint c) { return c == Constraint::clamped || c == Constraint::driven; }

/// Pins are constrained particles without a constrained neighbour (2D), or in a single row (3D). As clamps they would
/// resist a rotation (THEORY.md, Clamps).
Constraints make_constraints(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
