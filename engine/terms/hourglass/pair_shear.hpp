#pragma once

#include "engine/core/cube_root.hpp"
#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

/// Isotropic stress on particles and shear on pairs, [Wu2023] as in the sources of SPHinXsys. Departures: the law of
/// `tl`, with the exponents of 3D and τ = K J (J − 1) instead of ½ K (J² − 1), and c0 in the damping of all components.
namespace taut {

/// Weight of a pair's shear, Pa; `G` includes the factor 1.07 of the paper.
template <class T>
T pair_shear_modulus(const T& G, const T& j) {
  const T root = inverse_cube_root(j);
  return G * root * root;
}

/// First Piola–Kirchhoff stress without pair shear, Pa. `g`: pair_shear_modulus; `chi` = ½ ρ0 c0 h, Pa s.
template <class T, int Dim>
Mat<T, Dim> isotropic_piola(const Mat<T, Dim>& F, const Mat<T, Dim>& rate, const T& K, const T& g,
                            const T& chi) {
  const T j = determinant(F);
  const Mat<T, Dim> rotated = product_transposed(rate, F);
  T square = filled<T>(3 - Dim);
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) square += F(a, b) * F(a, b);
  Mat<T, Dim> tau;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) tau(a, b) = 0.5 * chi * (rotated(a, b) + rotated(b, a));
  for (int a = 0; a < Dim; ++a) tau(a, a) += K * j * (j - 1) - g * square / 3;
  return T(1 / j) * product(tau, cofactor(F));
}

/// Force of j on i, N; s = V_i V_j (∂W/∂r)/|X_ij|.
template <class T, int Dim>
Vec<T, Dim> pair_shear_force(const Mat<T, Dim>& P_i, const Mat<T, Dim>& P_j, const T& g_i, const T& g_j,
                             const Vec<T, Dim>& X_ij, const Vec<T, Dim>& x_ij, const T& s) {
  return s * ((P_i + P_j) * X_ij + T(g_i + g_j) * x_ij);
}
inline constexpr TermInfo isotropic_stress_info{
    "isotropic stress", "P = (K J (J − 1) I − ⅓ g F:F I + ¼ ρ0 c0 h (Ḟ Fᵀ + F Ḟᵀ)) F⁻ᵀ, g = 1.07 G J^(−2/3)",
    "[Wu2023]", "terms/hourglass/pair_shear.hpp:isotropic_piola",
    "pair shear: with the shear of pairs the stress is neo-Hookean"};
inline constexpr TermInfo pair_shear_info{"internal force",
                                          "f_i = Σ V_i V_j ((P_i + P_j) X + (g_i + g_j) x)/|X| ∂W/∂r",
                                          "[Wu2023]", "terms/hourglass/pair_shear.hpp:pair_shear_force",
                                          "pair shear: with the shear of pairs the stress is neo-Hookean"};

}  // namespace taut
