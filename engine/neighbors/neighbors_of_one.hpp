#pragma once

#include <algorithm>
#include <vector>

#include "engine/core/tensor.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/neighbors/neighbors.hpp"

namespace taut {

/// Computes initial_neighbors for one particle at a time to save memory.
template <int Dim>
class NeighborsOfOne {
 public:
  NeighborsOfOne(const InitialParticles& initial, double reach)
      : initial_(initial), reach_(reach), x_(initial.size()) {
    for (int i = 0; i < initial.size(); ++i) x_[i] = place(i);
    order_ = grid_.sort(x_, reach);
    std::ranges::transform(order_, x_.begin(), [this](int id) { return place(id); });
  }

  /// Ascending ids.
  std::vector<int> operator()(int i) const {
    std::vector<int> near;
    near.reserve(Dim == 3 ? 256 : 64);
    const Vec<double, Dim> x = place(i);
    grid_.for_each_row(x, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        const Vec<double, Dim> d = x - x_[k];
        const int j = order_[k];
        if (dot(d, d) < reach_ * reach_ && j != i && initial_.body[j] == initial_.body[i]) near.push_back(j);
      }
    });
    std::ranges::sort(near);
    return near;
  }

 private:
  Vec<double, Dim> place(int id) const {
    Vec<double, Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = initial_.x[id][k];
    return x;
  }

  const InitialParticles& initial_;
  double reach_;
  std::vector<Vec<double, Dim>> x_;  // in grid order
  CellGrid<Dim> grid_;
  std::vector<int> order_;  // ids
};

}  // namespace taut
