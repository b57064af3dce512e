#pragma once

#include <cstddef>


namespace taut {

/// Plain data of a Snapshot.
struct SnapshotView {
  std::size_t size;
  const double *x, *v, *m, *rho, *p, *s;
  const double* strain_energy;  // null: from p and s
  const int* material;
};
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

struct HistoryKernels {
  /// Sums of squares of the alternating parts of x (with `spacing`² at most), p and stress, and of p and stress
  /// themselves: out[0 … 2] and out[3 … 5], see AlternatingSums.
  void (*alternating_sums)(const AlternatingView& part, const SnapshotView& now, double spacing, double* out);
  /// Kinetic and strain energy, scales of linear and angular momentum; linear momentum; angular momentum: 4, 3 and 3
  /// numbers. `materials` by material.
  void (*balance)(const SnapshotView& now, const StrainDivisors* materials, double contact_energy,
                  double* out);
};

}  // namespace taut
