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

/// By name; lengths in m.
using ConstantValues = std::map<std::string_view, double>;

template <class C>
C constants_of(const std::vector<ConstantRow<C>>& rows, const Constants& all, const ConstantValues& values) {
  C c{all};
  for (const ConstantRow<C>& row : rows) c.*row.member = values.at(row.constant.name);
  return c;
}

struct SolverInput {
  const Formulation& method;
  const Scene& scene;
  const InitialParticles& initial;
  Constants constants;
  std::vector<Elasticity> materials;  // in the order of Scene::materials
  Law law;
  ContactLaw contact;    // never `published`
  bool keeps_neighbors;  // see FamilyRow
  Stepping stepping;
  int threads;
  InstructionSet kernels{};  // best that may be used
  ConstantValues values = {};
};

}  // namespace taut
