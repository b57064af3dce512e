#pragma once

#include "engine/materials/elastic_law.hpp"
#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut {

enum class Unknowns : std::uint8_t {
  v_F,  // [Lee2016] §3.3.2
  v_F_J,
  v_F_H_J,
};

struct TlMixedSwitches {
  Unknowns unknowns = Unknowns::v_F;
  bool jst = false;  // dissipation of [Lee2016] §3.4
};

struct TlMixedFormulation : Formulation, ElasticSwitches, TlMixedSwitches {
  static constexpr Family own_family = Family::tl_mixed;
};

struct TlMixedConstants : Constants {
  double eps_v2 = 0, eps_v4 = 0;
  double eps_J2 = 0, eps_J4 = 0;
  double adjoint = 0;         // 1: adjoint, 0: as printed
  double internal_force = 0;  // index in internal_force_names
  double deviator_ratio = 0;  // index in deviator_ratio_names
  double projection = 0;
  double boundary_projection = 0;
};

constexpr bool follows_volume_ratio(const TlMixedFormulation& m) { return m.unknowns != Unknowns::v_F; }

constexpr bool consistent(const TlMixedFormulation& m) {
  return m.kernel == KernelName::wendland_c2 &&  // assumed in solver.cpp
         (!follows_volume_ratio(m) || (takes_volume_ratio(m.law) && m.others != OtherLaws::all));
}

}  // namespace taut
