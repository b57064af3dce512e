#pragma once

#include "engine/materials/elastic_law.hpp"
#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut {

struct BondedFormulation : Formulation, ElasticSwitches {
  static constexpr Family own_family = Family::bonded;
};

struct BondedConstants : Constants {
  double damping = 0;
};

}  // namespace taut
