#pragma once

#include "engine/materials/elastic_law.hpp"
#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/solver/initial_pairs.hpp"

namespace taut {

enum class PairForce : std::uint8_t {
  none,
  hourglass,  // resists motions that F misses
  shear,      // carries the shear stress
};

struct TlDisplacementSwitches {
  GradientCorrection gradient = GradientCorrection::corrected;
  PairForce pair_force = PairForce::none;
};

struct TlDisplacementFormulation : Formulation, ElasticSwitches, TlDisplacementSwitches {
  static constexpr Family own_family = Family::tl_displacement;
};

struct TlDisplacementConstants : Constants {
  double normalised = 0;
  double alpha = 0;
  double shear_factor = 0, damping = 0;
};

}  // namespace taut
