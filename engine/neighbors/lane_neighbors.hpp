#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/columns.hpp"

/// Neighbours of particles of which four are worked on at once, one a lane: a group of four that are stored
/// one behind the other. Stored along the rows of a lattice or the layers of a round body, the same neighbour
/// of each (the one to the right, say) mostly stands one behind the other too, and what is gathered of them
/// is one load from a column. Each lane sums over the neighbours of its own particle in their order, so that
/// the result does not depend on who shares its group.
namespace taut {

/// One neighbour of each of four particles. Groups with the same neighbourhood have the same slots.
struct LaneSlot {
  int step[lanes];  // from the first of the four particles to the neighbour of each
  int in_line;      // 1: these stand one behind the other
};

/// What `columns` hold of the neighbours in a slot of the group that begins with particle `first`.
template <int N>
[[gnu::always_inline]] inline void gather(const ColumnsView<N>& columns, int first, const LaneSlot& slot,
                                          Pack (&out)[N]) {
  const int* const step = slot.step;
  if (slot.in_line != 0) [[likely]] {
#pragma GCC unroll 9
    for (int k = 0; k < N; ++k) out[k] = load(columns[k] + first + step[0]);
  } else {
#pragma GCC unroll 9
    for (int k = 0; k < N; ++k) {
      const double* const at = columns[k] + first;
      out[k] = Pack{at[step[0]], at[step[1]], at[step[2]], at[step[3]]};
    }
  }
}

struct LaneSlots {
  using Taken = std::array<int, lanes>;
  std::vector<LaneSlot> slots;
  /// For each slot and lane, which of the lane's neighbours it is; −1 if none. Such a lane leads to any
  /// particle: what the pair is multiplied with must be 0.
  std::vector<Taken> taken;
};

namespace lane_neighbors {

using Neighbors = std::array<std::vector<int>, lanes>;

/// Slots as few as may be: the first neighbours of all lanes, the second, …
inline std::vector<LaneSlots::Taken> in_turn(const Neighbors& neighbors) {
  std::vector<LaneSlots::Taken> taken;
  for (int n = 0;; ++n) {
    LaneSlots::Taken next;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      next[lane] = n < static_cast<int>(neighbors[lane].size()) ? n : -1;
    if (std::ranges::all_of(next, [](int one) { return one < 0; })) return taken;
    taken.push_back(next);
  }
}

/// All neighbours of a slot as far from their particles in storage.
inline std::vector<LaneSlots::Taken> by_distance(const Neighbors& neighbors) {
  std::vector<LaneSlots::Taken> taken;
  std::size_t at[lanes] = {};
  const auto left = [&](std::size_t lane) { return at[lane] < neighbors[lane].size(); };
  const auto distance = [&](std::size_t lane) { return neighbors[lane][at[lane]] - static_cast<int>(lane); };
  for (;;) {
    bool any_left = false;
    int least = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!left(lane)) continue;
      least = any_left ? std::min(least, distance(lane)) : distance(lane);
      any_left = true;
    }
    if (!any_left) return taken;
    LaneSlots::Taken next;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      next[lane] = left(lane) && distance(lane) == least ? static_cast<int>(at[lane]++) : -1;
    taken.push_back(next);
  }
}

inline LaneSlot slot(int first, const Neighbors& neighbors, const LaneSlots::Taken& taken, int size) {
  LaneSlot slot{};
  int begin = 0;  // of the line
  bool found = false, in_line = true;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const int own = static_cast<int>(lane);
    slot.step[lane] = own;  // the particle itself
    if (taken[lane] < 0) continue;
    const int j = neighbors[lane][static_cast<std::size_t>(taken[lane])];
    slot.step[lane] = j - first;
    if (!found) begin = j - own, found = true;
    in_line = in_line && begin == j - own;
  }
  if (!in_line || begin < 0 || begin + lanes > size) return slot;
  for (int lane = 0; lane < lanes; ++lane) slot.step[lane] = begin - first + lane;
  slot.in_line = 1;
  return slot;
}

}  // namespace lane_neighbors

/// Slots of the group that begins with particle `first`, of the neighbours of each of the four, which ascend;
/// fewer in the last group. `size`: that of the columns to gather from. Of two ways to choose slots the
/// cheaper one; one whose neighbours are not in line costs about as much as two that are.
inline LaneSlots lane_slots(int first, const std::array<std::vector<int>, lanes>& neighbors, int size) {
  LaneSlots best;
  std::size_t least = 0;
  for (auto& taken : {lane_neighbors::by_distance(neighbors), lane_neighbors::in_turn(neighbors)}) {
    LaneSlots one;
    one.slots.reserve(taken.size());
    std::size_t cost = 0;
    for (const LaneSlots::Taken& of_slot : taken) {
      one.slots.push_back(lane_neighbors::slot(first, neighbors, of_slot, size));
      cost += one.slots.back().in_line != 0 ? 1 : 2;
    }
    one.taken = taken;
    if (best.slots.empty() || cost < least) best = std::move(one), least = cost;
  }
  return best;
}

}  // namespace taut
