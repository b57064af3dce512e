#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <variant>
#include <vector>

#include "engine/materials/elastic_law.hpp"
#include "engine/materials/linear_elastic.hpp"
#include "engine/materials/mooney_rivlin.hpp"
#include "engine/materials/neo_hookean.hpp"
#include "engine/materials/rotated_piola.hpp"
#include "engine/materials/st_venant_kirchhoff.hpp"
#include "engine/methods/constants.hpp"

namespace taut {

template <Law... L>
struct LawList {
  static constexpr std::array rows{LawOf<L>::row...};
  using Each = std::variant<std::vector<LawOf<L>>...>;  // of one law, [material]
};

/// In the order of display.
using Laws = LawList<Law::neo_hookean, Law::mooney_rivlin, Law::st_venant_kirchhoff, Law::linear_elastic,
                     Law::rotated_piola>;

template <Law L>
concept TakesVolumeRatio = requires(LawOf<L> law, Mat<double, 3> F) {
  law.piola(F, F, 1.0);
};
static_assert([]<Law... L>(LawList<L...>) {
  return ((TakesVolumeRatio<L> == takes_volume_ratio(L)) && ...);
}(Laws{}));

/// Whether the law may replace the method's own.
constexpr bool may_be_given(const ElasticSwitches& m, const LawRow& row) {
  return m.others != OtherLaws::none && !row.choice.empty() &&
         (m.others == OtherLaws::all || takes_volume_ratio(row.law));
}

constexpr const LawRow& law_row(Law law) { return *std::ranges::find(Laws::rows, law, &LawRow::law); }

template <Law L>
LawOf<L> law_of(const Elasticity& e) {
  constexpr std::size_t own = LawOf<L>::row.parameters.size();
  static_assert(own <= most_law_parameters);
  return [&]<std::size_t... k>(std::index_sequence<k...>) { return LawOf<L>{{e.K, e.G, e.of_law[k]...}}; }
  (std::make_index_sequence<own>());
}

}  // namespace taut
