#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

enum class Constraint : unsigned char {
  free,     // also temporarily driven, or driven on a face
  pinned,   // fixed, but the body can rotate
  clamped,  // fixed
  driven    // driven until the end of the run
};
using Constraints = std::vector<Constraint>;  // by id

inline bool is_rigid(Constraint c) { return c == Constraint::clamped || c == Constraint::driven; }

/// For pins see THEORY.md, Clamps.
Constraints make_constraints(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
