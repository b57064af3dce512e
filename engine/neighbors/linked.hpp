#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "engine/scene/material_point.hpp"

namespace taut {

/// Leaves out of those around a place the ones beyond a slot, that no step from one beside it leads to. Squared
/// distances in spacings: from_place(one), between(one, other).
template <class T, class FromPlace, class Between>
void leave_out_unlinked(std::vector<T>& near, const FromPlace& from_place, const Between& between) {
  constexpr double link2 = link_of_neighbors * link_of_neighbors;
  std::vector<T> beside;
  std::ranges::copy_if(near, std::back_inserter(beside),
                       [&](const T& one) { return from_place(one) < link2; });
  if (beside.size() == near.size()) return;
  std::erase_if(near, [&](const T& one) {
    return from_place(one) >= link2 &&
           std::ranges::none_of(beside, [&](const T& other) { return between(one, other) < link2; });
  });
}

}  // namespace taut
