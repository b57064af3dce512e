#pragma once

#include <cstddef>

#include "engine/diagnostics/alternating_part.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Sums of squares: of a length in m², of p and of the von Mises stress in Pa².
struct SquareSums {
  double x = 0, p = 0, von_mises = 0;
};
/// Over the particles that have a row.
struct AlternatingSums {
  SquareSums part;   // of what alternates; a length counts with one spacing at most
  SquareSums whole;  // of the particles themselves, but for their places
};

// The sums over all particles in a row of history.csv; the same to the last bit for any instruction set.
AlternatingSums alternating_sums(const AlternatingPart& part, const Snapshot& now, double spacing,
                                 InstructionSet allowed = InstructionSet::x86_64_v4);
/// All of Balance.
Balance sums_of(const Snapshot& now, const Scene& scene, InstructionSet allowed = InstructionSet::x86_64_v4);

}  // namespace taut
