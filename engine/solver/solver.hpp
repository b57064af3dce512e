#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "engine/core/isa.hpp"
#include "engine/layout.hpp"
#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/scene.hpp"
#include "engine/simulation.hpp"

namespace taut {

/// What a solver is made from.
struct SolverInput {
  const Scene& scene;
  const Layout& layout;
  Constants constants;
  std::vector<Elasticity> materials;  // in the order of Scene::materials
  Law law;                            // of a method whose law is free
  ContactLaw contact;                 // never `published`
  Stepping stepping;
  int threads;
};

inline namespace TAUT_ISA {
/// The solver of a method, for this instruction set; nullptr if there is no such method.
std::unique_ptr<Simulation> make_solver(std::string_view method, const SolverInput& input);
}  // namespace TAUT_ISA

#if defined(__x86_64__)
namespace x86_64_v3 {
std::unique_ptr<Simulation> make_solver(std::string_view method, const SolverInput& input);
}
#endif

}  // namespace taut
