#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Weight w_i of a pair, N/m^(4 − Dim).
inline double hourglass_weight(double alpha, double E_i, double V_i, double V_j, double W, double r) {
  return 0.5 * alpha * E_i * V_i * V_j * W / (r * r);
}

/// Force of j on i, N, against the part of the distance that F does not explain. [Ganzenmueller2015] as in
/// TrixiParticles. Departure: MACHDYN limits δ and adds a share of h to distances.
template <class T, int Dim>
Vec<T, Dim> hourglass_force(const Mat<T, Dim>& F_i, const Mat<T, Dim>& F_j, const Vec<T, Dim>& X_ij,
                            const Vec<T, Dim>& x_ij, const T& w_i, const T& w_j) {
  const T r2 = dot(x_ij, x_ij), none{};
  const T excess_i = dot(F_i * X_ij, x_ij) - r2, excess_j = dot(F_j * X_ij, x_ij) - r2;
  return (r2 > none ? T((w_i * excess_i + w_j * excess_j) / r2) : none) * x_ij;
}
inline constexpr TermInfo hourglass_force_info{
    "hourglass force", "f_i += ½ α Σ V_i V_j W (E_i δ_i + E_j δ_j)/|X|² e, δ_i = (F_i X − x)·e, e = x/|x|",
    "[Ganzenmueller2015]", "terms/hourglass/hourglass_force.hpp:hourglass_force",
    "hourglass force: the force is 0 in an affine motion, acts along pairs and opposes zigzags"};

}  // namespace taut
