#pragma once

#include "engine/materials/elastic_law.hpp"
#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/solver/initial_pairs.hpp"

namespace taut {

struct TlDisplacementSwitches {
  GradientCorrection gradient = GradientCorrection::corrected;
};

struct TlDisplacementFormulation : Formulation, ElasticSwitches, TlDisplacementSwitches {
  static constexpr Family own_family = Family::tl_displacement;
};

struct TlDisplacementConstants : Constants {
  double normalised = 0;  // 1: divides uncorrected gradients by the kernel sum
};

}  // namespace taut
