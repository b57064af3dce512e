#pragma once

#include "engine/materials/elastic_law.hpp"
#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut {

struct FiniteElementFormulation : Formulation, ElasticSwitches {
  static constexpr Family own_family = Family::finite_elements;
};

struct FiniteElementConstants : Constants {};

constexpr bool consistent(const FiniteElementFormulation& m) {
  return m.element_order == 1 || m.element_order == 2;
}

}  // namespace taut
