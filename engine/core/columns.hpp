#pragma once

#include <algorithm>
#include <vector>

#include "engine/core/tensor.hpp"

namespace taut {

template <int N>
struct ColumnsView {
  double* all = nullptr;
  int length = 0;  // a multiple of `lanes`

  double* operator[](int k) const { return all + static_cast<std::ptrdiff_t>(k) * length; }
  int size() const { return length; }
};

template <int N>
class Columns : public ColumnsView<N> {
  using ColumnsView<N>::all, ColumnsView<N>::length;

 public:
  Columns() = default;
  Columns(const Columns&) = delete;
  Columns& operator=(const Columns&) = delete;

  void resize(int size) {
    length = (size + lanes - 1) / lanes * lanes;
    numbers_.assign(static_cast<std::size_t>(N) * length, 0.0);
    all = numbers_.data();
  }

 private:
  std::vector<double> numbers_;
};

/// Converts columns (x0 x1 x2 x3, y0 …) to rows (x0 y0 x1 …).
inline void interleave(const Pack (&columns)[2], Pack (&rows)[2]) {
  const auto& [x, y] = columns;
  rows[0] = __builtin_shufflevector(x, y, 0, 4, 1, 5);
  rows[1] = __builtin_shufflevector(x, y, 2, 6, 3, 7);
}
inline void interleave(const Pack (&columns)[3], Pack (&rows)[3]) {
  const auto& [x, y, z] = columns;
  const Pack x0y0x1 = __builtin_shufflevector(x, y, 0, 4, 1, 5);
  const Pack x2y2y1 = __builtin_shufflevector(x, y, 2, 6, 5, 5);
  const Pack x3y3 = __builtin_shufflevector(x, y, 3, 7, 3, 7);
  rows[0] = __builtin_shufflevector(x0y0x1, z, 0, 1, 4, 2);
  rows[1] = __builtin_shufflevector(x2y2y1, z, 2, 5, 0, 1);
  rows[2] = __builtin_shufflevector(x3y3, z, 6, 0, 1, 7);
}
inline void separate(const Pack (&rows)[2], Pack (&columns)[2]) {
  const auto& [a, b] = rows;
  columns[0] = __builtin_shufflevector(a, b, 0, 2, 4, 6);
  columns[1] = __builtin_shufflevector(a, b, 1, 3, 5, 7);
}
inline void separate(const Pack (&rows)[3], Pack (&columns)[3]) {
  const auto& [a, b, c] = rows;
  columns[0] = __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 3, 6, 6), c, 0, 1, 2, 5);
  columns[1] = __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 4, 7, 7), c, 0, 1, 2, 6);
  columns[2] = __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 5, 5, 5), c, 0, 1, 4, 7);
}

template <int Dim, int N>
Vec<Pack, Dim> vector_at(const ColumnsView<N>& columns, int first) {
  Vec<Pack, Dim> v;
  for (int k = 0; k < Dim; ++k) v[k] = load(columns[k] + first);
  return v;
}
template <int N>
void put(const Vec<Pack, N>& v, const ColumnsView<N>& columns, int first) {
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) store(v[k], columns[k] + first);
}
template <int Dim>
void put(const Mat<Pack, Dim>& A, const ColumnsView<Dim * Dim>& columns, int first) {
#pragma GCC unroll 3
  for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
    for (int b = 0; b < Dim; ++b) store(A(a, b), columns[a * Dim + b] + first);
}

/// Lanes from `count` on are 0.
template <int Dim>
Vec<Pack, Dim> load_four(const Vec<double, Dim>* rows, int count) {
  Vec<Pack, Dim> v{};
  if (count < lanes) [[unlikely]] {
    for (int lane = 0; lane < count; ++lane)
      for (int k = 0; k < Dim; ++k) v[k][lane] = rows[lane][k];
  } else if constexpr (Dim == 2) {
    const Pack a = load(rows[0].c), b = load(rows[2].c);
    v[0] = __builtin_shufflevector(a, b, 0, 2, 4, 6);
    v[1] = __builtin_shufflevector(a, b, 1, 3, 5, 7);
  } else {
    for (int k = 0; k < Dim; ++k) v[k] = Pack{rows[0][k], rows[1][k], rows[2][k], rows[3][k]};
  }
  return v;
}
template <int Dim>
void store_four(const Vec<Pack, Dim>& v, Vec<double, Dim>* rows, int count) {
  if (Dim == 2 && count >= lanes) [[likely]] {
    store(__builtin_shufflevector(v[0], v[1], 0, 4, 1, 5), rows[0].c);
    store(__builtin_shufflevector(v[0], v[1], 2, 6, 3, 7), rows[2].c);
  } else {
    for (int lane = 0; lane < std::min(count, lanes); ++lane) rows[lane] = lane_of(v, lane);
  }
}
template <int Dim>
Vec<Pack, Dim> load_four(const std::vector<Vec<double, Dim>>& rows, int first) {
  return load_four(&rows[first], static_cast<int>(rows.size()) - first);
}
template <int Dim>
void store_four(const Vec<Pack, Dim>& v, std::vector<Vec<double, Dim>>& rows, int first) {
  store_four(v, &rows[first], static_cast<int>(rows.size()) - first);
}

}  // namespace taut
