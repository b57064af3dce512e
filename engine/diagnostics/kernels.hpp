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
/// Particles from `first` to before `end`.
inline SnapshotView view_of(const Snapshot& now, std::size_t first, std::size_t end) {
  const std::size_t dim = static_cast<std::size_t>(now.dim), stress = now.dim == 3 ? 6 : 4;
  return {.size = end - first,
          .x = now.x.data() + dim * first,
          .v = now.v.data() + dim * first,
          .m = now.m.data() + first,
          .rho = now.rho.data() + first,
          .p = now.p.data() + first,
          .s = now.s.data() + stress * first,
          .strain_energy = now.strain_energy.empty() ? nullptr : now.strain_energy.data() + first,
          .material = now.material.data() + first};
}
inline SnapshotView view_of(const Snapshot& now) { return view_of(now, 0, now.size()); }
struct AlternatingView {
  int rows;
  const int *begin, *j, *first_weight;
  const double* weight;
};
/// Divisors of p²/2K + s:s/4G, Pa.
struct StrainDivisors {
  double twice_K, four_G;
};

/// Sums for a row of history.csv, bit-identical for all instruction sets.
struct HistoryKernels {
  /// Three sums of AlternatingSums::part, x at most `spacing`² each, then those of `whole`. `squared`: [row]
  /// AlternatingSums::x.
  void (*alternating_sums)(const AlternatingView& part, const SnapshotView& now, double spacing, double* out,
                           double* squared);
  /// 4 + 3 + 3 numbers: kinetic and strain energy, scales of linear and angular momentum; linear; angular momentum.
  void (*balance)(const SnapshotView& now, const StrainDivisors* materials, double contact_energy,
                  double* out);
};

}  // namespace taut
