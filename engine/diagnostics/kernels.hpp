#pragma once

#include <cstddef>

#include "engine/snapshot.hpp"

namespace taut {

/// Pointers into a Snapshot.
struct SnapshotView {
  std::size_t size;
  const double *x, *v, *m, *rho, *p, *s;
  const double* strain_energy;  // null: computed from p and s
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
/// Pointers into an AlternatingPart.
struct AlternatingView {
  int rows;
  const int *begin, *j, *first_weight;
  const double* weight;
};
/// Divisors of the strain energy p²/2K + s:s/4G, Pa.
struct StrainDivisors {
  double twice_K, four_G;
};

/// Sums over particles for a row of history.csv; bit-identical for all instruction sets.
struct HistoryKernels {
  /// Sums of squares of the alternating parts of x (each at most `spacing`²), p and stress, out[0 … 2], and of p and
  /// stress, out[3 … 5]; see AlternatingSums.
  void (*alternating_sums)(const AlternatingView& part, const SnapshotView& now, double spacing, double* out);
  /// Writes 4 + 3 + 3 numbers: kinetic and strain energy, scales of linear and angular momentum; linear; angular
  /// momentum. `materials`: by material.
  void (*balance)(const SnapshotView& now, const StrainDivisors* materials, double contact_energy,
                  double* out);
};

}  // namespace taut
