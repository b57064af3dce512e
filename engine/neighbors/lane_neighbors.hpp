#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/columns.hpp"

/// Slots: neighbours of four consecutive particles, one per lane. A single load reads consecutive neighbours. Each lane
/// takes its neighbours in ascending order.
namespace taut {

struct LaneSlot {
  int step[lanes];  // offset from the group's first particle
  int in_line;      // 1: neighbours are consecutive
};

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
  /// Index in the neighbour list of each lane; −1: an arbitrary particle is loaded, and the pair's factor must be 0.
  std::vector<Taken> taken;
};

namespace lane_neighbors {

using Neighbors = std::array<std::vector<int>, lanes>;

/// Fewest slots: first neighbours, second neighbours, …
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

/// Each slot takes neighbours at the same distance in storage.
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
  int begin = 0;
  bool found = false, in_line = true;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const int own = static_cast<int>(lane);
    slot.step[lane] = own;
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

/// `neighbors` must be ascending.
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
