#pragma once

#include "engine/methods/formulation.hpp"

/// Common data of the total-Lagrangian methods of [Lee2016]. The paper has no contact: these methods use the penalty
/// of [TranDuc2023] with the stiffness of a layer of the material.
namespace taut {

constexpr Formulation lee2016(Formulation m) {
  m.deviator = Deviator::plane_strain;
  m.several_materials = m.family != Family::tl_mixed;  // the momentum is not smooth where two materials meet
  m.contact = ContactLaw::penalty;
  m.contact_stiffness = 2;
  // [Lee2016] states neither kernel nor h. A short support smooths least and is least one-sided at faces. Zigzags
  // along all axes, invisible to gradients, decay much faster than with h near dp (JST tests). The supports contain 8
  // neighbours of a square and 26 of a cubic lattice.
  m.h_over_dp = 0.8;
  m.h_over_dp_3d = 0.87;
  // [Lee2016] §5 has 0.3, with which waves grow: the bending column fails at ν = 0.499.
  if (m.family == Family::tl_mixed) m.cfl = 0.25;
  return m;
}

}  // namespace taut
