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
  double normalised = 0;                 // 1: divides uncorrected gradients by the kernel sum
  double alpha = 0;                      // of the hourglass force
  double shear_factor = 0, damping = 0;  // of pair shear
};

}  // namespace taut
