#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

enum class Constraint : unsigned char {
  free,    // includes particles driven for part of the run, or driven in a body with `on_boundary`
  pinned,  // clamped or driven; bonded like a free particle
  clamped,
  driven  // to the end of the run
};
using Constraints = std::vector<Constraint>;  // by id

/// Bonds end at the faces of rigid regions (THEORY.md, Clamps).
inline bool is_rigid(Constraint c) { return c == Constraint::clamped || c == Constraint::driven; }

/// Pins are rigid particles without a rigid neighbour (2D) or in a single row (3D), see THEORY.md.
Constraints make_constraints(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
