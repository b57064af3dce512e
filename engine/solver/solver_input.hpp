#pragma once

#include <vector>

#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/scene/initial_particles.hpp"
#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"

namespace taut {

/// What a solver is made from.
struct SolverInput {
  const Formulation& method;
  const Scene& scene;
  const InitialParticles& initial;
  Constants constants;
  std::vector<Elasticity> materials;  // in the order of Scene::materials
  Law law;                            // of a method whose law is free
  ContactLaw contact;                 // never `published`
  bool meets_itself;                  // contact acts between parts of one body that were far apart
  Stepping stepping;
  int threads;
  InstructionSet instruction_set = InstructionSet::x86_64_v4;  // the greatest allowed
};

}  // namespace taut
