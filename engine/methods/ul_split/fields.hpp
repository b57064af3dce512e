#pragma once

#include <type_traits>

#include "engine/core/rows.hpp"
#include "engine/methods/ul_split/formulation.hpp"

namespace taut {

/// Velocity in m/s, pressure in Pa and volume in m^Dim; some passes store another vector and scalar.
template <int Dim>
struct FlowRow : Row<Dim + 2> {
  using Row<Dim + 2>::c;
  void set(const Vec<double, Dim>& v, double p, double V) {
    for (int k = 0; k < Dim; ++k) c[k] = v[k];
    c[Dim] = p;
    c[Dim + 1] = V;
  }
};
template <int Dim, class T>
struct Flow {
  Vec<T, Dim> v;
  T p;
  T V;
};

template <int Dim>
struct TensorRow : Row<Sym<double, Dim>::size + 1> {
  using Row<Sym<double, Dim>::size + 1>::c;
  void set(const Sym<double, Dim>& s, double a = 0) {
    for (int k = 0; k < Sym<double, Dim>::size; ++k) c[k] = s.c[k];
    c[Sym<double, Dim>::size] = a;
  }
  Sym<double, Dim> get() const {
    Sym<double, Dim> s;
    for (int k = 0; k < Sym<double, Dim>::size; ++k) s.c[k] = c[k];
    return s;
  }
  double scalar() const { return c[Sym<double, Dim>::size]; }
};

template <int Dim>
struct GradientRow : Row<Dim * Dim> {
  using Row<Dim * Dim>::c;
  void set(const Mat<double, Dim>& L) {
    for (int k = 0; k < Dim * Dim; ++k) c[k] = L(k / Dim, k % Dim);
  }
};
template <int Dim>
Mat<Pack, Dim> gather_gradient(const GradientRow<Dim>* rows, const int* j) {
  Pack column[GradientRow<Dim>::width];
  gather<GradientRow<Dim>::width>(rows[0].c, j, column);
  Mat<Pack, Dim> L;
  for (int k = 0; k < Dim * Dim; ++k) L(k / Dim, k % Dim) = column[k];
  return L;
}
template <int Dim>
Mat<Pack, Dim> spread_gradient(const GradientRow<Dim>& row) {
  Mat<Pack, Dim> L;
  for (int k = 0; k < Dim * Dim; ++k) L(k / Dim, k % Dim) = filled<Pack>(row.c[k]);
  return L;
}

template <int Dim>
Flow<Dim, Pack> gather_flow(const FlowRow<Dim>* rows, const int* j) {
  Pack column[Dim + 2];
  gather<Dim + 2, FlowRow<Dim>::width>(rows[0].c, j, column);
  Flow<Dim, Pack> f;
  for (int k = 0; k < Dim; ++k) f.v[k] = column[k];
  f.p = column[Dim];
  f.V = column[Dim + 1];
  return f;
}
template <int Dim>
Flow<Dim, Pack> spread_flow(const FlowRow<Dim>& row) {
  Flow<Dim, Pack> f;
  for (int k = 0; k < Dim; ++k) f.v[k] = filled<Pack>(row.c[k]);
  f.p = filled<Pack>(row.c[Dim]);
  f.V = filled<Pack>(row.c[Dim + 1]);
  return f;
}

template <int Dim>
struct Tensor {
  Sym<Pack, Dim> s;
  Pack a;
};
template <int Dim>
Tensor<Dim> gather_tensor(const TensorRow<Dim>* rows, const int* j) {
  Pack column[TensorRow<Dim>::width];
  gather<TensorRow<Dim>::width>(rows[0].c, j, column);
  Tensor<Dim> t;
  for (int k = 0; k < Sym<Pack, Dim>::size; ++k) t.s.c[k] = column[k];
  t.a = column[Sym<Pack, Dim>::size];
  return t;
}
template <int Dim>
Tensor<Dim> spread_tensor(const TensorRow<Dim>& row) {
  Tensor<Dim> t;
  for (int k = 0; k < Sym<Pack, Dim>::size; ++k) t.s.c[k] = filled<Pack>(row.c[k]);
  t.a = filled<Pack>(row.c[Sym<Pack, Dim>::size]);
  return t;
}

template <int Dim>
struct PairGeometry {
  Vec<Pack, Dim> gradient;  // ∇_i W = ∂W/∂r e_ij, 1/m^(Dim+1)
  Pack inverse_slope;       // 1/(∂W/∂r)
  Pack inverse_distance;    // (1/r)/(∂W/∂r); 0 between bodies: no shear
};

/// Gradients are 0 in padding; the gradients of (i, j) and (j, i) are exactly opposite. Single precision saves memory
/// in 3D; kernel units fit its range.
template <int Dim>
struct PairCache {
  static constexpr bool single_precision = Dim == 3;
  using Stored = std::conditional_t<single_precision, HalfPack, AlignedPack>;
  /// Least −r ∂W/∂r in kernel units; below it, inverses would overflow.
  static constexpr double least = single_precision ? 1e-30 : 0;

  Stored* gradients;  // Dim per pack
  Stored *inverse_slopes, *inverse_distances;
  Stored* closeness_of;
  double steepness, length;  // kernel units in 1/m^(Dim+1) and m; 1 in double precision

  void set(int b, const PairGeometry<Dim>& pairs) const {
    for (int k = 0; k < Dim; ++k) pack_into(gradients[Dim * b + k], pairs.gradient[k] * (1 / steepness));
    pack_into(inverse_slopes[b], pairs.inverse_slope * steepness);
    pack_into(inverse_distances[b], pairs.inverse_distance * (steepness * length));
  }
  void set_closeness(int b, const Pack& closeness) const { pack_into(closeness_of[b], closeness); }
  Pack closeness(int b) const { return unpacked(closeness_of[b]); }
  PairGeometry<Dim> operator[](int b) const { return {gradient(b), inverse_slope(b), inverse_distance(b)}; }
  Vec<Pack, Dim> gradient(int b) const {
    Vec<Pack, Dim> g;
    for (int k = 0; k < Dim; ++k) g[k] = scaled(unpacked(gradients[Dim * b + k]), steepness);
    return g;
  }
  Pack inverse_slope(int b) const { return scaled(unpacked(inverse_slopes[b]), 1 / steepness); }
  Pack inverse_distance(int b) const {
    return scaled(unpacked(inverse_distances[b]), 1 / (steepness * length));
  }

 private:
  static Pack scaled(const Pack& a, double unit) {
    if constexpr (single_precision) return unit * a;
    return a;
  }
};

/// Pack of neighbours of i, some in another body.
struct MixedPack {
  int i, pack;
};

/// Unused arrays are null.
template <int Dim>
struct UlSplitFields {
  using V = Vec<double, Dim>;
  using S = Sym<double, Dim>;

  int size;
  V* x;
  const V* v;
  const double *m, *mobile;
  const int *id, *body;
  double *rho, *drho;     // kg/m³ and its rate
  V *a_shear, *da_shear;  // accumulated acceleration, m/s², and its rate
  S *s, *ds;              // deviatoric stress, Pa, and its rate
  bool sph_contact;       // pairs of two bodies interact

  FlowRow<Dim>* flow;         // v at the start of the step, p and V at mid-step
  FlowRow<Dim>* flow_new;     // with the new velocity
  TensorRow<Dim>* stress;     // s
  TensorRow<Dim>* repulsion;  // artificial stress and mass
  // gradient correction and volume at the last rebuild
  TensorRow<Dim>* recovery;
  GradientRow<Dim>* velocity_gradient;  // with a penalty: L, 1/s

  const int *begin, *j;  // see Neighbors
  int* has_foreign_neighbors;
  PairCache<Dim> pairs;
  const MixedPack* mixed;
  int mixed_count;

  const int* pack(int b) const { return j + static_cast<std::ptrdiff_t>(lanes) * b; }
};

}  // namespace taut
