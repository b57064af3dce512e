#pragma once

#include <algorithm>

#include "engine/core/pack.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// What the bulk moduli of two touching particles make of the stiffness of their contact, Pa:
/// stiffness · K1 K2/(K1 + K2).  [TranDuc2023] Eq. 2.13 has stiffness = 1, K/2 for two of one material.
/// There u/dp is the strain of a particle, u being how far its face is pressed towards its centre. Between
/// centre and face lies half a spacing, so the strain is twice that, and stiffness = 2: then a layer of one
/// spacing between the outermost particles of two faces resists as if it were of the material.
/// Symmetric to the last bit, and exact for K1 = K2.
inline double contact_modulus(double K1, double K2, double stiffness) {
  const double softer = std::min(K1, K2), harder = std::max(K1, K2);
  return stiffness * (softer * (harder / (softer + harder)));
}

/// Force between two particles of two bodies, N (per metre depth in 2D): K dp^(d−2) (dp − r) where r < dp, 0
/// beyond, K the contact's modulus, Pa. Faces are in touch when their particles are one spacing apart. It
/// acts along the pair and has the energy below.  [TranDuc2023] Eq. 2.13–2.15
inline double penalty_force(double r, double dp, double K, int dim) {
  const double area = dim == 3 ? dp : 1;
  return K * area * std::max(dp - r, 0.0);
}

/// J (per metre depth in 2D)
inline double penalty_energy(double r, double dp, double K, int dim) {
  return 0.5 * penalty_force(r, dp, K, dim) * std::max(dp - r, 0.0);
}

inline constexpr ContactLawRow penalty_contact{
    .law = ContactLaw::penalty,
    .help = "spring with a stiffness from the bulk modulus, [TranDuc2023] Eq. 2.13 to 2.15",
    .term = {"contact", "f = s K1 K2/(K1 + K2) dp^(d−2) (dp − r) between bodies", "[TranDuc2023] Eq. 2.13",
             "terms/penalty_contact.hpp:penalty_force",
             "penalty contact: the force is the slope of the energy and vanishes beyond one spacing"},
    .between = ContactBetween::particles,
    .force = penalty_force,
    .energy = penalty_energy,
};

}  // namespace taut
