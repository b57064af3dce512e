#pragma once

#include "engine/methods/formulation.hpp"

/// Common data for [Lee2016], which has no contact: penalty of [TranDuc2023] with the stiffness of a material layer.
namespace taut {

constexpr Formulation lee2016(Formulation m) {
  m.deviator = Deviator::plane_strain;
  m.several_materials = m.family != Family::tl_mixed;  // momentum is not smooth at interfaces
  m.contact = ContactLaw::penalty;
  m.contact_stiffness = 2;
  // [Lee2016] states neither kernel nor h. Short supports (8 neighbours, 26 in 3D) are least one-sided at faces; at h
  // near dp zigzags hardly decay.
  m.h_over_dp = 0.8;
  m.h_over_dp_3d = 0.87;
  // [Lee2016] §5: 0.3; the bending column fails there at ν = 0.499.
  if (m.family == Family::tl_mixed) m.cfl = 0.25;
  return m;
}

}  // namespace taut
