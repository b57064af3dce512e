#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/core/tensor.hpp"
#include "engine/error.hpp"

namespace taut::inline TAUT_ISA {

/// Cells at least as wide as the support, a border of empty ones around them. Particles are meant to be kept
/// in the order of their cells, x fastest, so that three cells side by side are one stretch of memory.
template <int Dim>
class CellGrid {
 public:
  /// Lays the grid around `x` and returns the order in which the particles must be stored (stable).
  const std::vector<int>& sort(const std::vector<Vec<double, Dim>>& x, double support) {
    place(x, support);
    const int n = static_cast<int>(x.size());
    cell_.resize(n);
    order_.resize(n);
    start_.assign(cells_ + 1, 0);
    for (int i = 0; i < n; ++i) ++start_[(cell_[i] = cell_of(x[i])) + 1];
    for (int c = 0; c < cells_; ++c) start_[c + 1] += start_[c];
    for (int i = 0; i < n; ++i) order_[start_[cell_[i]]++] = i;
    for (int c = cells_; c > 0; --c) start_[c] = start_[c - 1];
    start_[0] = 0;
    return order_;
  }

  /// f(first, last) for each stretch of stored particles that may hold neighbours of a particle at x.
  template <class F>
  void for_each_row(const Vec<double, Dim>& x, const F& f) const {
    const int c = cell_of(x);
    const int depth = Dim == 3 ? 1 : 0;
    for (int dz = -depth; dz <= depth; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        const int row = c + dy * stride_[1] + (Dim == 3 ? dz * stride_[Dim - 1] : 0);
        f(start_[row - 1], start_[row + 2]);
      }
    }
  }

 private:
  [[noreturn]] static void refuse() {
    throw NumericalError(0, 0, -1, "position",
                         "the position of a particle is not finite, or too large for the neighbour search");
  }

  /// NumericalError where there is a place without a cell; who makes steps says when that was.
  void place(const std::vector<Vec<double, Dim>>& x, double support) {
    Vec<double, Dim> low = x[0], high = x[0];
    constexpr double farthest = 1e300;  // m; the sums below stay finite
    for (const auto& p : x) {
      for (int k = 0; k < Dim; ++k) {
        if (!(std::abs(p[k]) <= farthest)) refuse();
        low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
      }
    }
    // a body that flies apart must not ask for more memory: wider cells are as right, only slower
    const double most = 1000 + 8.0 * static_cast<double>(x.size());
    size_ = support;
    const auto along = [&](int k) { return std::floor((high[k] - low[k]) / size_) + 4; };
    const auto count = [&] {
      double cells = 1;
      for (int k = 0; k < Dim; ++k) cells *= along(k);
      return cells;
    };
    while (count() > most) size_ *= 1.5;
    if (!(size_ < 1e5 * farthest)) refuse();      // of a support that is no number
    const double farthest_cell = 0x1p44 * size_;  // the last digits of a place must tell its cell
    for (int k = 0; k < Dim; ++k)
      if (std::max(std::abs(low[k]), std::abs(high[k])) > farthest_cell) refuse();
    cells_ = 1;
    for (int k = 0; k < Dim; ++k) {
      origin_[k] =
          low[k] - 1.5 * size_;  // not by one cell: rounding could put the first particle into the border
      stride_[k] = cells_;
      cells_ *= static_cast<int>(along(k));
    }
  }

  int cell_of(const Vec<double, Dim>& x) const {
    int c = 0;
    for (int k = 0; k < Dim; ++k) c += stride_[k] * static_cast<int>((x[k] - origin_[k]) / size_);
    return c;
  }

  Vec<double, Dim> origin_{};
  double size_ = 0;  // m
  int stride_[Dim] = {};
  int cells_ = 0;
  std::vector<int> start_;  // [cell] first stored particle
  std::vector<int> cell_, order_;
};

/// Neighbours of each particle, flat: those of i are j[lanes · begin[i]] … j[lanes · begin[i + 1] − 1],
/// filled up with i itself to whole packs.
struct Neighbors {
  std::vector<int> begin;  // [n + 1] in packs
  std::vector<int> j;
  long pairs = 0;  // directed, without the filling

  const int* pack(int b) const { return &j[static_cast<std::size_t>(lanes) * b]; }

  template <class Archive>
  void serialize(Archive& archive, std::size_t particles) {
    archive.rows(begin, particles, j, particles, lanes);
    archive(pairs);
  }
};

/// All pairs nearer than the support, of particles stored in the grid's order, that `wanted(i, j)`. The lists do
/// not depend on the number of threads.
template <int Dim>
class NeighborSearch {
 public:
  void operator()(const CellGrid<Dim>& grid, const std::vector<Vec<double, Dim>>& x, double support,
                  int threads, Neighbors& out) {
    (*this)(grid, x, support, threads, out, [](int, int) { return true; });
  }

  template <class Wanted>
  void operator()(const CellGrid<Dim>& grid, const std::vector<Vec<double, Dim>>& x, double support,
                  int threads, Neighbors& out, const Wanted& wanted) {
    const int n = static_cast<int>(x.size());
    out.begin.resize(n + 1);
    out.begin[0] = 0;
    count_.resize(n);
    for (auto& along : x_) along.resize(n + lanes);
    parallel_for(n, threads, [&](int i) {
      for (int k = 0; k < Dim; ++k) x_[k][i] = x[i][k];
    });
    found_.resize(chunks_of(n, threads));
    parallel_chunks(n, threads, [&](int chunk, int first, int last) {
      find(grid, x, support, first, last, wanted, found_[chunk]);
    });
    out.pairs = 0;
    for (int i = 0; i < n; ++i) {
      out.begin[i + 1] = out.begin[i] + (count_[i] + lanes - 1) / lanes;
      out.pairs += count_[i];
    }
    out.j.resize(static_cast<std::size_t>(lanes) * out.begin[n]);
    parallel_chunks(n, threads, [&](int chunk, int first, int last) {
      const std::ptrdiff_t from = out.begin[first], to = out.begin[last];
      std::copy_n(found_[chunk].data(), lanes * (to - from), out.j.data() + lanes * from);
    });
  }

 private:
  typedef int Indices __attribute__((vector_size(lanes * sizeof(int))));

  /// Looks at four candidates at once. `found`: the neighbours of first … last − 1, of each filled up to
  /// whole packs.
  template <class Wanted>
  void find(const CellGrid<Dim>& grid, const std::vector<Vec<double, Dim>>& x, double support, int first,
            int last, const Wanted& wanted, std::vector<int>& found) {
    std::size_t size = 0;
    for (int i = first; i < last; ++i) {
      const std::size_t before = size;
      grid.for_each_row(x[i], [&](int begin, int end) {
        if (const std::size_t needed = size + (end - begin) + 2 * lanes; found.size() < needed) {
          found.reserve(needed + needed / 8);  // resize alone would take twice as much
          found.resize(found.capacity());
        }
        int* to = found.data() + size;
        for (int j = begin; j < end; j += lanes) {
          unsigned near = lanes_where(squared_distances(x[i], j) < support * support);
          near &= ~(static_cast<unsigned>(i - j) < lanes ? 1U << (i - j) : 0);
          near &= (1U << std::min(end - j, lanes)) - 1;
          const Indices hits = j + packed[near];
          std::memcpy(to, &hits, sizeof(hits));
          to += std::popcount(near);
        }
        size = to - found.data();
      });
      int* const list = found.data();
      const auto unwanted = [&](int j) { return !wanted(i, j); };
      size = std::remove_if(list + before, list + size, unwanted) - list;
      count_[i] = static_cast<int>(size - before);
      while (size % lanes != 0) list[size++] = i;
    }
  }

  Pack squared_distances(const Vec<double, Dim>& x_i, int j) const {
    Vec<Pack, Dim> d;
    for (int k = 0; k < Dim; ++k) d[k] = x_i[k] - load(&x_[k][j]);
    return dot(d, d);
  }

  /// The lanes whose bits are set in the number, one after the other.
  static constexpr Indices packed[] = {{},     {0},       {1},       {0, 1},      {2},    {0, 2},
                                       {1, 2}, {0, 1, 2}, {3},       {0, 3},      {1, 3}, {0, 1, 3},
                                       {2, 3}, {0, 2, 3}, {1, 2, 3}, {0, 1, 2, 3}};

  std::array<std::vector<double>, Dim> x_;  // each coordinate for itself, m
  std::vector<int> count_;
  std::vector<std::vector<int>> found_;  // [chunk]
};

}  // namespace taut::inline TAUT_ISA
