#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/materials/elastic_law.hpp"
#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"

namespace taut {

/// The constants of a method by name: those of the settings, and for the rest their defaults; lengths in m.
using ConstantValues = std::map<std::string_view, double>;

/// `all`, and with them the values of the rows of a family.
template <class C>
C constants_of(const std::vector<ConstantRow<C>>& rows, const Constants& all, const ConstantValues& values) {
  C c{all};
  for (const ConstantRow<C>& row : rows) c.*row.member = values.at(row.constant.name);
  return c;
}

/// What a solver is made from.
struct SolverInput {
  const Formulation& method;
  const Scene& scene;
  const InitialParticles& initial;
  Constants constants;
  std::vector<Elasticity> materials;  // in the order of Scene::materials
  Law law;                            // of a method whose law is free
  ContactLaw contact;                 // never `published`
  bool keeps_neighbors;  // see FamilyRow; contact acts between parts of one body that were far apart
  Stepping stepping;
  int threads;
  InstructionSet kernels{};    // the greatest allowed
  ConstantValues values = {};  // for the constants of the family
};

}  // namespace taut
