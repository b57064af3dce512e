#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Ascending ids.
struct NeighborLists {
  std::vector<std::size_t> begin;  // [n + 1]
  std::vector<int> j;

  std::span<const int> operator[](int i) const { return {j.data() + begin[i], begin[i + 1] - begin[i]}; }
  /// Index in j; `other` must be in the list of i.
  std::size_t find(int i, int other) const;
};

/// Neighbours in the same body within `reach`, m.
NeighborLists initial_neighbors(const InitialParticles& initial, double reach, int threads = 1);
/// Excludes particles beyond a slot (linked.hpp).
NeighborLists linked_neighbors(const InitialParticles& initial, double reach, double spacing,
                               int threads = 1);

}  // namespace taut
