#pragma once

#include <cstddef>

#include "engine/snapshot.hpp"

namespace taut {

/// Plain data of a Snapshot.
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
/// Plain data of an AlternatingPart.
struct AlternatingView {
  int rows;
  const int *begin, *j, *first_weight;
  const double* weight;
};
/// The divisors of the strain energy p²/2K + s:s/4G, Pa.
struct StrainDivisors {
  double twice_K, four_G;
};

/// The sums over all particles in a row of history.csv; the same to the last bit for any instruction set.
struct HistoryKernels {
  /// Sums of squares of the alternating parts of x (with `spacing`² at most), p and stress, and of p and stress
  /// themselves: out[0 … 2] and out[3 … 5], see AlternatingSums.
  /// `squared`: [row] squares of the alternating part of x.
  void (*alternating_sums)(const AlternatingView& part, const SnapshotView& now, double spacing, double* out,
                           double* squared);
  /// Kinetic and strain energy, scales of linear and angular momentum; linear momentum; angular momentum: 4, 3 and 3
  /// numbers. `materials` by material.
  void (*balance)(const SnapshotView& now, const StrainDivisors* materials, double contact_energy,
                  double* out);
};

}  // namespace taut
