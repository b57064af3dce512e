#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Constraint of a particle's bonds by the scene.
enum class Constraint : unsigned char {
  free,     // includes temporarily driven particles and driven ones on a face
  pinned,   // fixed, but bonded like a free particle: the body can rotate
  clamped,  // fixed
  driven    // driven until the end of the run
};
using Constraints = std::vector<Constraint>;  // by id

/// Bonds end at the face of a rigid region (THEORY.md, Clamps).
inline bool is_rigid(Constraint c) { return c == Constraint::clamped || c == Constraint::driven; }

/// Constraints with pins: isolated constrained particles (2D) or single rows (3D). See THEORY.md, Clamps.
Constraints make_constraints(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
