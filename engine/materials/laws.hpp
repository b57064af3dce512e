#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "engine/materials/linear_elastic.hpp"
#include "engine/materials/neo_hookean.hpp"
#include "engine/materials/rotated_piola.hpp"
#include "engine/materials/st_venant_kirchhoff.hpp"
#include "engine/methods/constants.hpp"

namespace taut::inline TAUT_ISA {

template <Law... L>
struct LawList {
  static constexpr std::array rows{LawOf<L>::row...};
};

/// Every law, in the order in which they are offered. A law is an enumerator of Law, a header beside this one
/// and its name here.
using Laws = LawList<Law::neo_hookean, Law::st_venant_kirchhoff, Law::linear_elastic, Law::rotated_piola>;

constexpr const LawRow& law_row(Law law) { return *std::ranges::find(Laws::rows, law, &LawRow::law); }

/// The law with the numbers of a material.
template <Law L>
LawOf<L> law_of(const Elasticity& e) {
  constexpr std::size_t own = LawOf<L>::row.parameters.size();
  static_assert(own <= most_law_parameters);
  return [&]<std::size_t... k>(std::index_sequence<k...>) { return LawOf<L>{{e.K, e.G, e.of_law[k]...}}; }
  (std::make_index_sequence<own>());
}

}  // namespace taut::inline TAUT_ISA
