#pragma once

#include <type_traits>

#include "engine/core/rows.hpp"
#include "engine/kernels/kernel.hpp"
#include "engine/methods/ul_cauchy/formulation.hpp"

namespace taut {

/// Angular velocity, 1/s.
template <int Dim>
using Spin = std::conditional_t<Dim == 2, double, Vec<double, 3>>;
inline Vec<double, 2> times_arm(double spin, const Vec<double, 2>& arm) {
  return {-spin * arm[1], spin * arm[0]};
}
inline Vec<double, 3> times_arm(const Vec<double, 3>& spin, const Vec<double, 3>& arm) {
  return cross(spin, arm);
}

/// The velocity is u or û.
template <int Dim>
struct MotionRow : Row<2 * Dim + 2> {
  using Row<2 * Dim + 2>::c;
  static constexpr int x_at = Dim + 2;
  void set(const Vec<double, Dim>& v, double rho, double V, const Vec<double, Dim>& x) {
    for (int k = 0; k < Dim; ++k) c[k] = v[k], c[x_at + k] = x[k];
    c[Dim] = rho;
    c[Dim + 1] = V;
  }
  void put_velocity(const Vec<double, Dim>& v) {
    for (int k = 0; k < Dim; ++k) c[k] = v[k];
  }
};
template <int Dim>
struct Motion {
  Vec<Pack, Dim> v, x;  // m/s, m
  Pack rho, V;          // kg/m³, m^Dim
};

template <int Dim>
Motion<Dim> motion_of(const Pack* column, bool with_place) {
  Motion<Dim> m;
  for (int k = 0; k < Dim; ++k) m.v[k] = column[k];
  m.rho = column[Dim];
  m.V = column[Dim + 1];
  if (with_place)
    for (int k = 0; k < Dim; ++k) m.x[k] = column[MotionRow<Dim>::x_at + k];
  return m;
}
template <int Dim>
Motion<Dim> gather_motion(const MotionRow<Dim>* rows, const int* j) {
  Pack column[MotionRow<Dim>::width];
  gather<MotionRow<Dim>::width>(rows[0].c, j, column);
  return motion_of<Dim>(column, true);
}
template <int Dim>
Motion<Dim> gather_motion_only(const MotionRow<Dim>* rows, const int* j) {
  constexpr int width = Row<Dim + 2>::width;
  Pack column[width];
  gather<width, MotionRow<Dim>::width>(rows[0].c, j, column);
  return motion_of<Dim>(column, false);
}
template <int Dim>
Motion<Dim> spread_motion(const MotionRow<Dim>& row) {
  Pack column[MotionRow<Dim>::width];
  for (int k = 0; k < MotionRow<Dim>::width; ++k) column[k] = filled<Pack>(row.c[k]);
  return motion_of<Dim>(column, true);
}

/// Unused columns are omitted.
template <const UlCauchyFormulation& M, int Dim>
struct StressRow {
  static constexpr bool riemann = M.viscosity == Viscosity::riemann;
  static constexpr int S = Sym<double, Dim>::size;
  static constexpr int v_at = 0, rho_at = Dim, V_at = Dim + 1, T_at = Dim + 2, D_at = T_at + Dim * Dim;
  static constexpr int root_rho_at = D_at + (riemann ? S : 0);
  static constexpr int wave_at = root_rho_at + (riemann ? 1 : 0);  // c, or c ρ √ρ
  static constexpr int grad_rho_at = wave_at + (M.viscosity == Viscosity::none ? 0 : 1);
  static constexpr int surface_at = grad_rho_at + (M.density_diffusion ? Dim : 0);
  static constexpr int columns = surface_at + (M.tensile_control ? 1 : 0);
  static constexpr int width = row_width(columns);
  alignas(row_alignment(columns)) double c[width] = {};

  template <class Columns>
  struct Values : Columns {
    using Columns::column;

    Vec<Pack, Dim> v() const { return vector(v_at); }
    Pack rho() const { return column(rho_at); }
    Pack V() const { return column(V_at); }
    Pack weight() const { return M.pair_stress == PairStress::squares ? Pack(rho() * V()) : V(); }
    Mat<Pack, Dim> T() const { return matrix(T_at); }  // σ·L, σ or σ/ρ²
    Sym<Pack, Dim> D() const {
      Sym<Pack, Dim> D;
#pragma GCC unroll 6
      for (int k = 0; k < S; ++k) D.c[k] = column(D_at + k);
      return D;
    }
    Pack root_rho() const { return column(root_rho_at); }
    Pack impedance() const { return column(wave_at); }
    Pack c() const { return column(wave_at); }
    Vec<Pack, Dim> grad_rho() const { return vector(grad_rho_at); }
    Pack surface() const { return column(surface_at); }  // 1 or 0

    Vec<Pack, Dim> vector(int at) const {
      Vec<Pack, Dim> a;
#pragma GCC unroll 3
      for (int k = 0; k < Dim; ++k) a[k] = column(at + k);
      return a;
    }
    Mat<Pack, Dim> matrix(int at) const {
      Mat<Pack, Dim> A;
#pragma GCC unroll 3
      for (int k = 0; k < Dim; ++k)
#pragma GCC unroll 3
        for (int l = 0; l < Dim; ++l) A(k, l) = column(at + k * Dim + l);
      return A;
    }
  };
  struct SpreadRow {
    Pack spread[width];
    Pack column(int k) const { return spread[k]; }
  };

  /// Loads columns where they are used, because not all fit into registers.
  [[gnu::always_inline]] static Values<RowsOfFour> gather(const StressRow* rows, const int* j) {
    return {RowsOfFour(rows[0].c, width, j)};
  }
  static Values<SpreadRow> spread(const StressRow& row) {
    Values<SpreadRow> v;
    for (int k = 0; k < width; ++k) v.spread[k] = filled<Pack>(row.c[k]);
    return v;
  }
  void put(int at, double value) { c[at] = value; }
  void put(int at, const Vec<double, Dim>& a) {
    for (int k = 0; k < Dim; ++k) c[at + k] = a[k];
  }
  void put(int at, const Mat<double, Dim>& A) {
    for (int k = 0; k < Dim; ++k)
      for (int l = 0; l < Dim; ++l) c[at + k * Dim + l] = A(k, l);
  }
  void put(int at, const Sym<double, Dim>& A) {
    for (int k = 0; k < S; ++k) c[at + k] = A.c[k];
  }
};

/// StressRow::T with −σ⁺ in place of σ.
template <int Dim>
struct RepulsionRow : Row<Dim * Dim> {
  using Row<Dim * Dim>::c;
  void set(const Mat<double, Dim>& A) {
    for (int k = 0; k < Dim * Dim; ++k) c[k] = A(k / Dim, k % Dim);
  }
  Mat<double, Dim> get() const {
    Mat<double, Dim> A;
    for (int k = 0; k < Dim * Dim; ++k) A(k / Dim, k % Dim) = c[k];
    return A;
  }
  static Mat<Pack, Dim> gather(const RepulsionRow* rows, const int* j) {
    Mat<Pack, Dim> A;
    taut::gather<Dim * Dim, RepulsionRow::width>(rows[0].c, j, A.c[0]);
    return A;
  }
};

template <int Dim>
struct Gradients {
  Sym<double, Dim> L{};         // kernel gradient correction
  Sym<double, Dim> D{};         // symmetric part of ∇u, 1/s
  Vec<double, Dim> grad_rho{};  // kg/m⁴
  double colour = 0;            // Σ W V
};

/// Whether the method uses W, not only its gradient.
constexpr bool needs_kernel(const UlCauchyFormulation& m) {
  return m.artificial_stress || m.transport_velocity;
}

/// Unused arrays are null.
template <int Dim>
struct UlCauchyFields {
  using V = Vec<double, Dim>;

  int size;
  V* x;
  const V* v;
  const double *m, *mobile;
  const int *id, *body, *material;
  const Elasticity* materials;
  double *rho, *drho;           // kg/m³; its rate by density diffusion
  Sym<double, Dim>* s;          // deviatoric stress, Pa
  MotionRow<Dim>* motion;       // at the start of the step
  MotionRow<Dim>* moved;        // with the new velocity
  MotionRow<Dim>* transported;  // with û
  void* stress;                 // [particle] StressRow
  RepulsionRow<Dim>* repulsion;
  const int *begin, *j;                // see Neighbors
  AlignedPack* w;                      // w(q) of each pair, if needs_kernel
  const AlignedPack* of_one_material;  // null: all 1
  // [body] rigid motion since the last neighbour search
  const V *drift, *centre;  // m/s, m
  const Spin<Dim>* spin;    // 1/s

  template <const UlCauchyFormulation& M>
  StressRow<M, Dim>* stress_rows() const {
    return static_cast<StressRow<M, Dim>*>(stress);
  }
  const int* pack(int b) const { return j + static_cast<std::ptrdiff_t>(lanes) * b; }
  const Elasticity& material_of(int i) const { return materials[material[i]]; }
  /// x_i − x_j at the start of the step, m; exactly opposite for (j, i).
  [[gnu::always_inline]] Vec<Pack, Dim> apart(int i, int b) const {
    const RowsOfFour rows(motion[0].c, MotionRow<Dim>::width, pack(b));
    Vec<Pack, Dim> d;
    for (int k = 0; k < Dim; ++k)
      d[k] = motion[i].c[MotionRow<Dim>::x_at + k] - rows.column(MotionRow<Dim>::x_at + k);
    return d;
  }
  Pack same_material(int b) const { return of_one_material ? of_one_material[b].value : filled<Pack>(1); }
};

}  // namespace taut
