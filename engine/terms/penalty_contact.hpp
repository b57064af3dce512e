#pragma once

#include <algorithm>

#include "engine/core/pack.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// Contact modulus of two materials, Pa; [TranDuc2023] Eq. 2.13 has stiffness = 1. Symmetric to the last bit.
inline double contact_modulus(double K1, double K2, double stiffness) {
  const double softer = std::min(K1, K2), harder = std::max(K1, K2);
  return stiffness * (softer * (harder / (softer + harder)));
}

/// Repulsive force along a pair, N, 0 for r ≥ dp. [TranDuc2023] Eq. 2.13–2.15
inline double penalty_force(double r, double dp, double K, int dim) {
  const double area = dim == 3 ? dp : 1;
  return K * area * std::max(dp - r, 0.0);
}

/// Energy, J.
inline double penalty_energy(double r, double dp, double K, int dim) {
  return 0.5 * penalty_force(r, dp, K, dim) * std::max(dp - r, 0.0);
}

inline constexpr ContactLawRow penalty_contact{
    .law = ContactLaw::penalty,
    .help = "spring with a stiffness from the bulk modulus, [TranDuc2023] Eq. 2.13 to 2.15",
    .term = {"contact", "f = s K1 K2/(K1 + K2) dp^(d−2) (dp − r) between bodies", "[TranDuc2023] Eq. 2.13",
             "terms/penalty_contact.hpp:penalty_force",
             "penalty contact: the force is −∂E/∂r and vanishes beyond one spacing"},
    .between = ContactBetween::particles,
    .force = penalty_force,
    .energy = penalty_energy,
};

}  // namespace taut
