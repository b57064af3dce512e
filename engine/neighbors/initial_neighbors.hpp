#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Lists of others of each particle, by id and in the order of their ids.
struct NeighborLists {
  std::vector<std::size_t> begin;  // [n + 1]
  std::vector<int> j;

  std::span<const int> operator[](int i) const { return {j.data() + begin[i], begin[i + 1] - begin[i]}; }
  /// Where in j the list of i has `other`, which must be there.
  std::size_t find(int i, int other) const;
};

/// The other particles of its own body nearer than `reach`, m, to each particle at the start.
NeighborLists initial_neighbors(const InitialParticles& initial, double reach, int threads = 1);
/// The same without those beyond a slot (linked.hpp).
NeighborLists linked_neighbors(const InitialParticles& initial, double reach, double spacing,
                               int threads = 1);

}  // namespace taut
