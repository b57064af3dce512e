#pragma once

#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/core/tensor.hpp"

namespace taut {

/// Particles in storage order.
template <int Dim>
struct Particles {
  using V = Vec<double, Dim>;

  std::vector<V> x, v;         // m, m/s
  std::vector<double> m;       // kg
  std::vector<double> mobile;  // 1, or 0 where clamped
  std::vector<int> id;         // number in creation order
  std::vector<int> body;
  std::vector<int> material;

  int size() const { return static_cast<int>(x.size()); }

  std::vector<int> places_of_ids() const {
    std::vector<int> where(id.size());
    for (int i = 0; i < size(); ++i) where[id[i]] = i;
    return where;
  }
};

/// Moves row order[i] of each array to row i.
template <class... Arrays>
void reorder(const std::vector<int>& order, int threads, Arrays&... arrays) {
  const auto one = [&](auto& array) {
    if (array.empty()) return;
    auto sorted = array;
    parallel_for(static_cast<int>(order.size()), threads, [&](int i) { sorted[i] = array[order[i]]; });
    array.swap(sorted);
  };
  (one(arrays), ...);
}

}  // namespace taut
