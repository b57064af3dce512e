#pragma once

#include "engine/methods/formulation.hpp"

/// The data that the total-Lagrangian methods of [Lee2016] share. It has no contact between bodies: they take the
/// penalty of [TranDuc2023] with the stiffness of a layer of the material.
namespace taut {

constexpr Formulation lee2016(Formulation m) {
  m.deviator = Deviator::plane_strain;
  m.several_materials =
      m.family != Family::tl_mixed;  // the momentum of two materials is not smooth where they meet
  m.contact = ContactLaw::penalty;
  m.contact_stiffness = 2;
  // [Lee2016] states neither kernel nor h. A short support smooths least and is least one-sided at faces: with
  // the eight nearest of a square lattice stress across a bent block is five times as near as with the twelve
  // of 1.05 dp, and the zigzag along both axes, which no gradient sees, decays 16 times as fast. In 3D the 26
  // nearest of a cubic lattice: from h = dp on the Laplacian at the nearest particles changes its sign, and the
  // zigzag along all three axes hardly decays, 20 times as slowly at 1.05 dp as at 0.87 dp (tests "JST: what
  // zigzags decay by").
  m.h_over_dp = 0.8;
  m.h_over_dp_3d = 0.87;
  // [Lee2016] §5 takes 0.3. Waves grow slowly in two Runge–Kutta stages: at Poisson's ratio 0.499 the bending
  // column is lost at 0.3 and not at 0.25
  if (m.family == Family::tl_mixed) m.cfl = 0.25;
  return m;
}

}  // namespace taut
