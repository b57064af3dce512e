#pragma once

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "engine/contact/facet_pairs.hpp"
#include "engine/contact/motion_bound.hpp"
#include "engine/contact/moving_facets.hpp"
#include "engine/contact/near_other_bodies.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

class FacetCandidates {
 public:
  using V = Vec<double, 3>;

  FacetCandidates(const SolverInput& input, const MovingFacets& facets, double reach)
      : dp_(input.constants.dp),
        reach_(reach),
        meets_itself_(input.keeps_neighbors),
        meets_others_(input.scene.bodies.size() > 1 || !input.scene.walls.empty()),
        near_(facets, cluster * input.constants.dp),
        nodes_(facets.nodes_of(near_.order())) {
    for (int f = 0; f < facets.size(); ++f) normal_.push_back(facets[f].normal);
  }

  std::vector<std::pair<int, int>> pairs, near_wall;

  bool search(const Particles<3>& s, MovingFacets& facets, const WallContacts<3>& walls,
              std::optional<double> way) {
    const bool others = meets_others_ && !(way && others_bound_.holds(*way));
    bool own = meets_itself_ && !(way && own_bound_.holds(*way));
    if (others || own) facets.follow(s, particle_places_);
    if (others) {
      search_others(s, facets, walls);
      if (way) others_bound_.holds(*way);
    }
    own = own && !(way && own_bound_.still_holds(particle_places_, near_.bodies(), *way));
    if (own) {
      search_own(s, facets);
      if (way) own_bound_.holds(*way);
    }
    if (others || own) join();
    return others || own;
  }

  template <class Archive>
  void serialize(Archive& archive, int walls) {
    const int count = near_.size();
    for (auto* list : {&others_, &own_}) {
      archive.indices(*list, std::pair(count, count));
      archive.check("the pairs of facets", [&] { return are_both_ways(*list); });
    }
    if constexpr (Archive::loads) join();
    archive.indices(near_wall, std::pair(count, walls));
    archive(others_bound_, own_bound_);
  }

 private:
  // lengths in spacings
  static constexpr double skin = 1.4;
  static constexpr double horizon = 4.25;
  static constexpr double cluster = 4;       // width of facet clusters
  static constexpr double far_apart = 4;     // least initial distance along a face or across a gap
  static constexpr double far_inside = 8;    // least initial distance through the body
  static constexpr double flat = 1e-6;       // round-off of facets in one plane
  static constexpr double aside = 0.5;       // greatest cosine of the normals
  static constexpr double turn_slack = 0.5;  // for rotation of facets

  void search_others(const Particles<3>& s, MovingFacets& facets, const WallContacts<3>& walls) {
    constexpr double margin = horizon + 2;  // 2: each particle is within a spacing of its facet
    const std::vector<char> near = near_other_bodies<3>(particle_places_, near_.bodies(), margin * dp_);
    std::vector<int> candidates = near_.order();
    std::erase_if(candidates, [&](int f) { return !near[f]; });
    facets.place(s, facets.nodes_of(candidates), candidates, 1);
    others_bound_.restart(find<PairsOf::two_bodies>(
                              facets, candidates, [](int, int) { return true; }, others_),
                          {});
    near_wall.clear();
    for (int f = 0; f < near_.size(); ++f)
      for (int w = 0; w < walls.count(); ++w)
        if (walls.height(w, particle_places_[f]) < horizon * dp_) near_wall.emplace_back(f, w);
  }
  void search_own(const Particles<3>& s, MovingFacets& facets) {
    const auto wanted = [&](int f, int g) {
      const V D = near_.start(f) - near_.start(g);
      return dot(D, D) > far_inside * far_inside * dp_ * dp_ || dot(D, normal_[g] - normal_[f]) > -flat * dp_;
    };
    facets.place(s, nodes_, near_.order(), 1);
    own_bound_.restart(find<PairsOf::one_body>(facets, near_.order(), wanted, own_), particle_places_);
  }

  /// Returns the distance in m by which the nearest unlisted pair may still approach.
  template <PairsOf kind, class Wanted>
  double find(const MovingFacets& facets, const std::vector<int>& candidates, const Wanted& wanted,
              std::vector<std::pair<int, int>>& list) {
    found_.clear();
    const double beyond = near_.template find<kind>(
        facets, candidates,
        {.listed = reach_ + skin * dp_, .horizon = horizon * dp_, .far = far_apart * dp_, .cosine = aside},
        wanted, [&](int f, int g) { found_.emplace_back(f, g); });
    list_both_ways(list);
    return beyond - reach_ - turn_slack * dp_;
  }

  void list_both_ways(std::vector<std::pair<int, int>>& list) {
    std::vector<int> end(near_.size() + 1);  // [facet]
    for (const auto& [f, g] : found_) ++end[f + 1], ++end[g + 1];
    std::partial_sum(end.begin(), end.end(), end.begin());
    const std::vector<int> begin = end;
    list.resize(2 * found_.size());
    for (const auto& [f, g] : found_) list[end[f]++] = {f, g}, list[end[g]++] = {g, f};
    for (std::size_t f = 0; f + 1 < begin.size(); ++f)
      std::sort(list.begin() + begin[f], list.begin() + begin[f + 1]);
  }

  static bool are_both_ways(const std::vector<std::pair<int, int>>& list) {
    return std::ranges::is_sorted(list) && std::ranges::all_of(list, [&](const auto& pair) {
             return std::ranges::binary_search(list, std::pair(pair.second, pair.first));
           });
  }

  void join() {
    pairs.clear();
    std::merge(others_.begin(), others_.end(), own_.begin(), own_.end(), std::back_inserter(pairs));
  }

  double dp_, reach_;  // m
  bool meets_itself_, meets_others_;
  FacetPairs near_;
  std::vector<int> nodes_;          // all
  std::vector<V> normal_;           // [facet] initial unit normal
  std::vector<V> particle_places_;  // [facet] m
  std::vector<std::pair<int, int>> others_, own_, found_;
  MotionBound<3> others_bound_, own_bound_;
};

}  // namespace taut
