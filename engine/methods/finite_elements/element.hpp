#pragma once

#include "engine/core/cube_root.hpp"
#include "engine/methods/finite_elements/fields.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// out = Σ_k table[i][k] in[k] along an axis of a grid with n numbers per axis; table[k][i] if `transposed`.
template <int n, int Dim, int axis, bool transposed>
[[gnu::always_inline]] inline void along(const typename LineElement<n>::Table& table, const Pack* in,
                                         Pack* out) {
  constexpr int stride = axis == 0 ? 1 : axis == 1 ? n : n * n, rows = power_of(n, Dim) / (n * stride);
#pragma GCC unroll 9
  for (int row = 0; row < rows; ++row)
#pragma GCC unroll 3
    for (int i = 0; i < n; ++i)
#pragma GCC unroll 9
      for (int s = 0; s < stride; ++s) {
        const Pack* const from = in + row * n * stride + s;
        Pack sum = (transposed ? table[0][i] : table[i][0]) * from[0];
#pragma GCC unroll 3
        for (int k = 1; k < n; ++k) sum += (transposed ? table[k][i] : table[i][k]) * from[k * stride];
        out[(row * n + i) * stride + s] = sum;
      }
}

/// Derivative along axis `sloped` at the Gauss points from nodal values; transposed: its adjoint.
template <int n, int Dim, int sloped, bool transposed>
[[gnu::always_inline]] inline void differentiate(const Pack* in, Pack* out) {
  using Line = LineElement<n>;
  constexpr int N = power_of(n, Dim);
  Pack one[N], other[N];
  along<n, Dim, 0, transposed>(sloped == 0 ? Line::dN : Line::N, in, one);
  if constexpr (Dim == 2) {
    along<n, Dim, 1, transposed>(sloped == 1 ? Line::dN : Line::N, one, out);
  } else {
    along<n, Dim, 1, transposed>(sloped == 1 ? Line::dN : Line::N, one, other);
    along<n, Dim, 2, transposed>(sloped == 2 ? Line::dN : Line::N, other, out);
  }
}

template <class T>
T root_of(const T& a, std::integral_constant<int, 2>) {
  return root(a);
}
template <class T>
T root_of(const T& a, std::integral_constant<int, 3>) {
  return inverse_cube_root(T(1 / a));
}

/// F of four elements at their Gauss points, and F̄ = (J̄/J)^(1/d) F, [Simo1985], for small strains [Hughes1980]. J̄ is
/// J = det F projected on the constant (fe2: linear) functions of the element. Departure: d = 2 in 2D, not 3.
template <int n, int Dim>
struct ElementStrain {
  static constexpr int N = power_of(n, Dim), modes = volume_modes(n - 1, Dim);
  using Point = ElementPoint<Dim, modes>;

  Mat<Pack, Dim> F[N];
  Pack J[N], mean[N];  // det F, J̄

  [[gnu::always_inline]] ElementStrain(const Pack (&u)[Dim][N], const Point* points) {
    Pack slope[Dim][Dim][N];  // ∂u/∂ξ
    for (int c = 0; c < Dim; ++c) {
      differentiate<n, Dim, 0, false>(u[c], slope[c][0]);
      differentiate<n, Dim, 1, false>(u[c], slope[c][1]);
      if constexpr (Dim == 3) differentiate<n, Dim, 2, false>(u[c], slope[c][2]);
    }
    Pack sum[modes]{};
    for (int q = 0; q < N; ++q) {
      Mat<Pack, Dim> G;
      for (int c = 0; c < Dim; ++c)
        for (int d = 0; d < Dim; ++d) G(c, d) = slope[c][d][q];
      F[q] = product(G, points[q].to_local);
      for (int c = 0; c < Dim; ++c) F[q](c, c) += 1;
      J[q] = determinant(F[q]);
      for (int m = 0; m < modes; ++m) sum[m] += points[q].weight * points[q].mode[m] * (J[q] - 1);
    }
    for (int q = 0; q < N; ++q) mean[q] = 1 + projected(sum, points[q]);  // exactly 1 at rest
  }

  static Pack projected(const Pack (&sum)[modes], const Point& point) {
    Pack all = sum[0] * point.mode[0];
    for (int m = 1; m < modes; ++m) all += sum[m] * point.mode[m];
    return all;
  }
  Pack scale(int q) const { return root_of(Pack(mean[q] / J[q]), std::integral_constant<int, Dim>{}); }
  Mat<Pack, Dim> with_mean_volume(int q) const { return scale(q) * F[q]; }
};

/// Nodal forces −∂E/∂x, N, of E = Σ_q w ψ(F̄):
///   P = s P̄ + (Π(t/J̄) − t/J) cof F,  s = (J̄/J)^(1/d),  t = P̄:F̄/d,  Π: projection on the modes.
template <int n, int Dim, class Laws>
[[gnu::always_inline]] inline void element_force(const Pack (&u)[Dim][power_of(n, Dim)],
                                                 const typename ElementStrain<n, Dim>::Point* points,
                                                 const Laws& laws, Pack (&force)[Dim][power_of(n, Dim)]) {
  constexpr int N = power_of(n, Dim), modes = ElementStrain<n, Dim>::modes;
  const ElementStrain<n, Dim> strain(u, points);
  Mat<Pack, Dim> P[N];
  Pack t[N], sum[modes]{};
  for (int q = 0; q < N; ++q) {
    const Pack s = strain.scale(q);
    const Mat<Pack, Dim> F = s * strain.F[q];
    P[q] = laws([&](const auto& law) { return law.piola(F, strain.mean[q]); });
    t[q] = contraction(P[q], F) / Dim;
    const Pack by_volume = points[q].weight * t[q] / strain.mean[q];
    for (int m = 0; m < modes; ++m) sum[m] += by_volume * points[q].mode[m];
    P[q] = s * P[q];
  }
  Pack flux[Dim][Dim][N];
  for (int q = 0; q < N; ++q) {
    const Pack pressure = ElementStrain<n, Dim>::projected(sum, points[q]) - t[q] / strain.J[q];
    const Mat<Pack, Dim> all = combination(1.0, P[q], pressure, cofactor(strain.F[q]));
    for (int c = 0; c < Dim; ++c)
      for (int d = 0; d < Dim; ++d) {
        Pack of_axis = all(c, 0) * points[q].to_local(d, 0);
        for (int k = 1; k < Dim; ++k) of_axis += all(c, k) * points[q].to_local(d, k);
        flux[c][d][q] = points[q].weight * of_axis;
      }
  }
  for (int c = 0; c < Dim; ++c) {
    Pack part[N];
    differentiate<n, Dim, 0, true>(flux[c][0], force[c]);
    differentiate<n, Dim, 1, true>(flux[c][1], part);
    for (int a = 0; a < N; ++a) force[c][a] += part[a];
    if constexpr (Dim == 3) {
      differentiate<n, Dim, 2, true>(flux[c][2], part);
      for (int a = 0; a < N; ++a) force[c][a] += part[a];
    }
    for (int a = 0; a < N; ++a) force[c][a] = -force[c][a];
  }
}
inline constexpr TermInfo element_strain_info{
    "deformation gradient",
    "F̄ = (J̄/J)^(1/d) (1 + Σ_a u_a ∂N_a/∂X), J̄: mean of J in the element; fe2: linear fit of J",
    "[Simo1985]; here d = 2 in 2D", "methods/finite_elements/element.hpp:ElementStrain",
    "finite elements: linear displacements give uniform stress, rigid motions none"};
inline constexpr TermInfo element_force_info{
    "internal force", "f_a = −∂E/∂x_a, E = Σ_q w ψ(F̄)", "[Simo1985]",
    "methods/finite_elements/element.hpp:element_force",
    "finite elements: forces are minus the derivative of the strain energy"};

}  // namespace taut
