#pragma once

#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/core/tensor.hpp"

namespace taut {

/// The particles of a simulation with what every method has of each, in the order of storage: that of cells where a
/// method searches neighbours, else that of creation.
template <int Dim>
struct Particles {
  using V = Vec<double, Dim>;

  std::vector<V> x, v;         // m, m/s
  std::vector<double> m;       // kg (per metre depth in 2D)
  std::vector<double> mobile;  // 1, or 0 where clamped
  std::vector<int> id;         // place in the order of creation
  std::vector<int> body;
  std::vector<int> material;  // index into the materials of the scene

  int size() const { return static_cast<int>(x.size()); }

  /// Where the particle of each id is stored.
  std::vector<int> places_of_ids() const {
    std::vector<int> where(id.size());
    for (int i = 0; i < size(); ++i) where[id[i]] = i;
    return where;
  }
};

/// Stores the rows of each array in another order: row order[i] comes to i. Empty arrays stay empty.
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
