#pragma once

#include <cmath>
#include <string_view>

#include "engine/core/pack.hpp"
#include "engine/core/principal_axes.hpp"
#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

/// Gray's artificial stress. Departure: [Zhang2024] gives no equations and constants; they are from Gray et al. 2001.
namespace taut {

/// σ⁺ = Σ_k max(σ_k, 0) n_k ⊗ n_k
inline Sym<double, 2> positive_part(const Sym<double, 2>& sigma) {
  const double mean = 0.5 * trace(sigma);
  const double half = 0.5 * (sigma(0, 0) - sigma(1, 1));
  const double radius = std::sqrt(half * half + sigma(0, 1) * sigma(0, 1));
  const double greatest = mean + radius;
  if (mean - radius >= 0) return sigma;
  if (greatest <= 0) return {};
  const double scale = 0.5 * greatest / radius;
  return {scale * (radius + half), scale * sigma(0, 1), scale * (radius - half)};
}
/// The 3D form is ours: the papers treat the plane.
inline Sym<double, 3> positive_part(const Sym<double, 3>& sigma) {
  const Principal principal = principal_axes(sigma);
  Sym<double, 3> positive{};
  for (int k = 0; k < 3; ++k)
    if (principal.value[k] > 0) add_outer(positive, principal.value[k], principal.axis[k]);
  return positive;
}
inline constexpr TermInfo repulsion_info{
    "artificial stress", "dv/dt: terms of the stress divergence of −σ⁺, times ε (W/W(dp))ⁿ",
    "[Khayyer2024] Eq. 17–21", "terms/artificial_stress.hpp:positive_part",
    "artificial stress: the positive part keeps the axes and the positive principal stresses"};
inline constexpr TermInfo corrected_repulsion_info{
    "artificial stress", "dv/dt: terms of the stress divergence of −σ⁺, times ε (W/W(dp))ⁿ",
    "[Khayyer2024] Eq. 18–21, 31", "terms/artificial_stress.hpp:positive_part",
    "artificial stress: the positive part keeps the axes and the positive principal stresses"};
inline constexpr TermInfo surface_repulsion_info{
    "artificial stress, at surfaces", "dv/dt: terms of the stress divergence of −σ⁺, times ε (W/W(dp))ⁿ",
    "[Khayyer2024] Eq. 18–21, 31", "terms/artificial_stress.hpp:positive_part",
    "artificial stress: the positive part keeps the axes and the positive principal stresses"};

/// f_ij of [TranDuc2023] §2.2. Departure: `kernel` is Gray's (W/W(Δx))ⁿ; `distance` is the printed (r/Δx)ⁿ.
enum class RepulsionWeight { kernel, distance };
inline constexpr std::string_view repulsion_weight_names[] = {"kernel", "distance"};

inline Pack distance_weight(const Pack& r, double dp, double n) { return power(Pack(r / dp), n); }

/// R = −ε σ⁺/ρ², Pa m⁶/kg²
template <int Dim>
Sym<double, Dim> artificial_stress(const Sym<double, Dim>& sigma, double rho, double epsilon) {
  return (-epsilon / (rho * rho)) * positive_part(sigma);
}

/// Term j of an acceleration, m/s²; `closeness` = (W/W(dp))ⁿ.
template <class T, int Dim>
Vec<T, Dim> artificial_stress_term(const Sym<T, Dim>& R_i, const Sym<T, Dim>& R_j, const T& m_j,
                                   const T& closeness, const T& dW, const Vec<T, Dim>& e_ij) {
  return T(m_j * closeness * dW) * ((R_i + R_j) * e_ij);
}
inline constexpr TermInfo artificial_stress_info{
    "artificial stress", "dv/dt = Σ m_j (R_i + R_j) (W/W(dp))ⁿ·∇W, R = −ε σ⁺/ρ²",
    "[Zhang2024] §6, Gray et al. 2001", "terms/artificial_stress.hpp:artificial_stress_term",
    "artificial stress: a stretched pair is repelled, more strongly when closer"};

}  // namespace taut
