#pragma once

#include <algorithm>
#include <array>

#include "engine/families/bonded/describe.hpp"
#include "engine/families/tl_displacement/describe.hpp"
#include "engine/families/tl_mixed/describe.hpp"
#include "engine/families/ul_cauchy/describe.hpp"
#include "engine/families/ul_split/describe.hpp"

namespace taut {

/// What the tables know of a family. Its solvers come from its solver.cpp, see make_solver.hpp.
struct FamilyRow {
  Family family;
  bool searches;  // particles act on what comes near, and not just on their initial neighbours
  std::vector<TermInfo> (*terms)(const Formulation& m);
  std::vector<MethodConstant> (*constants)(const Formulation& m, int dim);
};

/// Every family: a folder beside this file, an enumerator and its row here.
inline constexpr std::array families{
    FamilyRow{Family::ul_split, true, ul_split::terms, ul_split::constants},
    FamilyRow{Family::ul_cauchy, true, ul_cauchy::terms, ul_cauchy::constants},
    FamilyRow{Family::bonded, false, bonded::terms, bonded::constants},
    FamilyRow{Family::tl_displacement, false, tl_displacement::terms, tl_displacement::constants},
    FamilyRow{Family::tl_mixed, false, tl_mixed::terms, tl_mixed::constants},
};

inline const FamilyRow& row_of(Family family) {
  return *std::ranges::find(families, family, &FamilyRow::family);
}

}  // namespace taut
