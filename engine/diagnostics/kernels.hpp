#pragma once

#include <cstddef>

#include "engine/snapshot.hpp"

namespace taut {

struct SnapshotView {
  std::size_t size;
  const double *x, *v, *m, *rho, *p, *s;
  const double* strain_energy;  // null: from p and s
  const int* material;
};
inline SnapshotView view_of(const Snapshot& now) {
  return {.size = now.size(),
          .x = now.x.data(),
          .v = now.v.data(),
          .m = now.m.data(),
          .rho = now.rho.data(),
          .p = now.p.data(),
          .s = now.s.data(),
          .strain_energy = now.strain_energy.empty() ? nullptr : now.strain_energy.data(),
          .material = now.material.data()};
}
struct AlternatingView {
  int rows;
  const int *begin, *j, *first_weight;
  const double* weight;
};
/// Divisors of p²/2K + s:s/4G, Pa.
struct StrainDivisors {
  double twice_K, four_G;
};

/// Sums for the history, bit-identical for all instruction sets.
struct HistoryKernels {
  /// Writes AlternatingSums::part and then `whole` to `out`, and AlternatingSums::x to `squared`.
  void (*alternating_sums)(const AlternatingView& part, const SnapshotView& now, double spacing, double* out,
                           double* squared);
  /// Writes 10 numbers: kinetic energy, strain plus contact energy, momentum_scale, angular_scale, linear momentum (3),
  /// angular momentum (3).
  void (*balance)(const SnapshotView& now, const StrainDivisors* materials, double contact_energy,
                  double* out);
};

}  // namespace taut
