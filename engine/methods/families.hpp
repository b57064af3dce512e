#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <type_traits>
#include <vector>

#include "engine/methods/bonded/describe.hpp"
#include "engine/methods/finite_elements/describe.hpp"
#include "engine/methods/tl_displacement/describe.hpp"
#include "engine/methods/tl_mixed/describe.hpp"
#include "engine/methods/ul_cauchy/describe.hpp"
#include "engine/methods/ul_split/describe.hpp"

namespace taut {

struct FamilyRow {
  Family family;
  bool keeps_neighbors;  // particles of a body keep initial neighbours
  std::vector<TermInfo> (*terms)(const Formulation& m);
  std::vector<MethodConstant> (*constants)(const Formulation& m, int dim);
  // returns nullptr without an elastic law
  const ElasticSwitches* (*elastic)(const Formulation& m);
  bool (*carries_stress)(const Formulation& m);  // forces use an integrated stress
  std::unique_ptr<Simulation> (*make)(const SolverInput& input);
};

template <class F, auto terms, auto constants>
constexpr FamilyRow family_row(std::unique_ptr<Simulation> (*make)(const SolverInput& input)) {
  constexpr bool elastic = std::is_base_of_v<ElasticSwitches, F>;
  return {.family = F::own_family,
          .keeps_neighbors = elastic,
          .terms = [](const Formulation& m) { return terms(*as<F>(m)); },
          .constants =
              [](const Formulation& m, int dim) {
                std::vector<MethodConstant> all;
                for (const auto& row : constants(*as<F>(m), dim)) all.push_back(row.constant);
                return all;
              },
          .elastic = []([[maybe_unused]] const Formulation& m) -> const ElasticSwitches* {
            if constexpr (elastic)
              return as<F>(m);
            else
              return nullptr;
          },
          .carries_stress =
              []([[maybe_unused]] const Formulation& m) {
                if constexpr (elastic)
                  return false;
                else
                  return carries_stress(*as<F>(m));
              },
          .make = make};
}

inline constexpr std::array families{
    family_row<UlSplitFormulation, ul_split::terms, ul_split::constants>(ul_split::make),
    family_row<UlCauchyFormulation, ul_cauchy::terms, ul_cauchy::constants>(ul_cauchy::make),
    family_row<BondedFormulation, bonded::terms, bonded::constants>(bonded::make),
    family_row<TlDisplacementFormulation, tl_displacement::terms, tl_displacement::constants>(
        tl_displacement::make),
    family_row<TlMixedFormulation, tl_mixed::terms, tl_mixed::constants>(tl_mixed::make),
    family_row<FiniteElementFormulation, finite_elements::terms, finite_elements::constants>(
        finite_elements::make),
};

inline const FamilyRow& row_of(Family family) {
  return *std::ranges::find(families, family, &FamilyRow::family);
}

}  // namespace taut
