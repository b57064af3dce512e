#pragma once

#include <algorithm>
#include <array>

#include "engine/families/bonded/describe.hpp"
#include "engine/families/tl_displacement/describe.hpp"
#include "engine/families/tl_mixed/describe.hpp"
#include "engine/families/ul_cauchy/describe.hpp"
#include "engine/families/ul_split/describe.hpp"

namespace taut {

/// What the tables know of a family.
struct FamilyRow {
  Family family;
  bool searches;  // particles act on what comes near, and not just on their initial neighbours
  std::vector<TermInfo> (*terms)(const Formulation& m);
  std::vector<MethodConstant> (*constants)(const Formulation& m, int dim);
  std::unique_ptr<Simulation> (*make)(const SolverInput& input);
};

/// Every family: a folder beside this file, an enumerator and its row here.
inline constexpr std::array families{
    FamilyRow{Family::ul_split, true, ul_split::terms, ul_split::constants, ul_split::make},
    FamilyRow{Family::ul_cauchy, true, ul_cauchy::terms, ul_cauchy::constants, ul_cauchy::make},
    FamilyRow{Family::bonded, false, bonded::terms, bonded::constants, bonded::make},
    FamilyRow{Family::tl_displacement, false, tl_displacement::terms, tl_displacement::constants,
              tl_displacement::make},
    FamilyRow{Family::tl_mixed, false, tl_mixed::terms, tl_mixed::constants, tl_mixed::make},
};

inline const FamilyRow& row_of(Family family) {
  return *std::ranges::find(families, family, &FamilyRow::family);
}

}  // namespace taut
