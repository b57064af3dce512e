#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace taut::test {

/// For each place, sorted indices of the other places nearer than `reach`.
template <class Place>
std::vector<std::vector<std::size_t>> neighbors_within(double reach, const std::vector<Place>& places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return places[i][0]; });
  std::vector<std::vector<std::size_t>> near(places.size());
  for (std::size_t a = 0; a < order.size(); ++a) {
    const Place& from = places[order[a]];
    for (std::size_t b = a + 1; b < order.size() && places[order[b]][0] - from[0] < reach; ++b) {
      const Place& to = places[order[b]];
      double squared = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(from.size()); ++k)
        squared += (to[k] - from[k]) * (to[k] - from[k]);
      if (squared >= reach * reach) continue;
      near[order[a]].push_back(order[b]);
      near[order[b]].push_back(order[a]);
    }
  }
  for (auto& list : near) std::ranges::sort(list);
  return near;
}

}  // namespace taut::test
