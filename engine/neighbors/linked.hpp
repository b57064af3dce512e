#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

#include "engine/layout/material_point.hpp"

namespace taut {

/// Moves the items linked to a place to the front, in order, and returns their number. A linked item lies within
/// link_of_neighbors of the place, or of an item within this distance of the place. `from_place` and `between` return
/// squared distances, in spacings.
template <class T, class FromPlace, class Between>
std::size_t bring_linked_to_front(std::span<T> near, const FromPlace& from_place, const Between& between) {
  constexpr double link2 = link_of_neighbors * link_of_neighbors;
  std::vector<T> beside;
  beside.reserve(near.size());
  std::ranges::copy_if(near, std::back_inserter(beside),
                       [&](const T& one) { return from_place(one) < link2; });
  if (beside.size() == near.size()) return near.size();
  const auto is_beyond = [&](const T& one) {
    return from_place(one) >= link2 &&
           std::ranges::none_of(beside, [&](const T& other) { return between(one, other) < link2; });
  };
  // clang 14 rejects std::ranges::remove_if on spans of libstdc++ 12
  return static_cast<std::size_t>(std::remove_if(near.begin(), near.end(), is_beyond) - near.begin());
}

template <class T, class FromPlace, class Between>
void leave_out_unlinked(std::vector<T>& near, const FromPlace& from_place, const Between& between) {
  const std::size_t linked = bring_linked_to_front(std::span<T>(near), from_place, between);
  near.erase(near.begin() + static_cast<std::ptrdiff_t>(linked), near.end());
}

}  // namespace taut
