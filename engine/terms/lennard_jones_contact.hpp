#pragma once

#include <algorithm>

#include "engine/core/pack.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// Distance, in spacings, below which the force stays constant.
inline constexpr double lennard_jones_core = 0.1;

/// Scale p̄ in J, with which the law is as stiff as the penalty law at first touch.
inline double lennard_jones_scale(double dp, double K, int dim) {
  return 0.5 * K * dp * dp * (dim == 3 ? dp : 1);
}

/// Repulsive force, N. [Zhang2020] Eq. 12 with n1 = 6, n2 = 4. Departure: the paper leaves p̄ open and
/// has k h_i + k h_j instead of dp.
inline double lennard_jones_force(double r, double dp, double K, int dim) {
  const double near = std::max(r, lennard_jones_core * dp), l2 = dp * dp / (near * near);
  return l2 > 1 ? lennard_jones_scale(dp, K, dim) * l2 * l2 * (l2 - 1) / near : 0;
}

/// Energy, J; linear in r inside the core.
inline double lennard_jones_energy(double r, double dp, double K, int dim) {
  const double near = std::max(r, lennard_jones_core * dp), l2 = dp * dp / (near * near);
  if (!(l2 > 1)) return 0;
  const double outside = lennard_jones_scale(dp, K, dim) * (l2 * l2 * l2 / 6 - l2 * l2 / 4 + 1.0 / 12);
  return outside + lennard_jones_force(near, dp, K, dim) * (near - r);
}

inline constexpr ContactLawRow lennard_jones_contact{
    .law = ContactLaw::lennard_jones,
    .help = "spring that hardens as particles approach, [Zhang2020] Eq. 12",
    .term = {"contact", "f = s/2 K1 K2/(K1 + K2) dp^d (l⁶ − l⁴)/r, l = dp/r ≥ 1, between bodies",
             "[Zhang2020] Eq. 12", "terms/lennard_jones_contact.hpp:lennard_jones_force",
             "Lennard-Jones contact: the force is −∂E/∂r and vanishes beyond one spacing"},
    .between = ContactBetween::particles,
    .force = lennard_jones_force,
    .energy = lennard_jones_energy,
};

}  // namespace taut
