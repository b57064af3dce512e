#pragma once

#include "engine/core/isa.hpp"
#include "engine/diagnostics/alternating_part.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/scene/scene.hpp"
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

// What a row of history.csv needs of every particle, for this instruction set; the same to the last bit for
// all.
inline namespace TAUT_ISA {
AlternatingSums alternating_sums(const AlternatingPart& part, const Snapshot& now, double spacing);
/// All of Balance.
Balance sums_of(const Snapshot& now, const Scene& scene);
}  // namespace TAUT_ISA

#ifdef TAUT_KNOWS_X86_64_LEVELS
namespace x86_64_v3 {
AlternatingSums alternating_sums(const AlternatingPart& part, const Snapshot& now, double spacing);
Balance sums_of(const Snapshot& now, const Scene& scene);
}  // namespace x86_64_v3
#endif

}  // namespace taut
