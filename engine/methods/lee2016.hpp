#pragma once

#include "engine/methods/formulation.hpp"

/// Common data of `tl-hg` and the methods of [Lee2016].
namespace taut {

inline constexpr Citation no_published_contact[] = {{"contact", "ours; none in the paper", ""}};

constexpr Formulation lee2016(Formulation m) {
  m.deviator = Deviator::plane_strain;
  // the mixed family has momentum as an unknown, which jumps between materials
  m.several_materials = m.family != Family::tl_mixed;
  m.contact = ContactLaw::surface;
  m.contact_stiffness = 2;
  if (m.paper.starts_with("Lee2016")) m.citations = no_published_contact;
  // [Lee2016] states neither kernel nor h. Short supports (8 neighbours, in 3D 26) are least one-sided at faces.
  m.h_over_dp = 0.8;
  m.h_over_dp_3d = 0.87;
  // Departure: [Lee2016] §5 has 0.3, with which the bending column fails at ν = 0.499.
  if (m.family == Family::tl_mixed) m.cfl = 0.25;
  return m;
}

}  // namespace taut
