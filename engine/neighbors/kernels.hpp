#pragma once

#include <cstddef>

#include "engine/core/tensor.hpp"

namespace taut {

template <int Dim>
struct CellsView {
  Vec<double, Dim> origin{};
  double size = 0;  // m
  int stride[Dim] = {};
  const int* start = nullptr;  // [cell] first stored particle

  int cell_of(const Vec<double, Dim>& x) const {
    int c = 0;
    for (int k = 0; k < Dim; ++k) c += stride[k] * static_cast<int>((x[k] - origin[k]) / size);
    return c;
  }
  /// Calls f(first, last) for ranges of stored particles that include all neighbours of x.
  template <class F>
  void for_each_row(const Vec<double, Dim>& x, const F& f) const {
    const int c = cell_of(x);
    const int depth = Dim == 3 ? 1 : 0;
    for (int dz = -depth; dz <= depth; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        const int row = c + dy * stride[1] + (Dim == 3 ? dz * stride[Dim - 1] : 0);
        f(start[row - 1], start[row + 2]);
      }
    }
  }
};

template <int Dim>
struct SearchFields {
  CellsView<Dim> cells;
  const double* x[Dim];  // m, padded for a pack at the end
  double support;        // m
  const int* body;       // [particle]; null: pairs of two bodies, too
};

template <int Dim>
struct SearchKernels {
  /// Writes neighbours of first … last − 1 to `found` from `size` on, padded to whole packs. Returns the first
  /// particle for which `room` is too small, or `last`.
  int (*find)(const SearchFields<Dim>& f, int first, int last, int* count, int* found, std::size_t room,
              std::size_t& size);
  std::size_t (*room_for)(const SearchFields<Dim>& f, int i);
};

}  // namespace taut
