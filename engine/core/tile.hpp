#pragma once

#include "engine/core/tensor.hpp"

/// A Dim × Dim tensor in whole packs, row by row: four of its entries are worked on at once, for one
/// neighbour after the other. Where all that is gathered of a neighbour is a vector or a tensor, this needs
/// neither the transposition of four gathered rows nor a filling of the lists.
namespace taut::inline TAUT_ISA {

template <int Dim>
struct alignas(lanes * sizeof(double)) Tile {
  static constexpr int packs = (Dim * Dim + lanes - 1) / lanes;
  Pack c[packs];

  Tile& operator+=(const Tile& b) {
    for (int k = 0; k < packs; ++k) c[k] += b.c[k];
    return *this;
  }
  friend Tile operator+(Tile a, const Tile& b) { return a += b; }
  friend Tile operator-(Tile a, const Tile& b) {
    for (int k = 0; k < packs; ++k) a.c[k] -= b.c[k];
    return a;
  }
  /// Entry by entry.
  friend Tile operator*(Tile a, const Tile& b) {
    for (int k = 0; k < packs; ++k) a.c[k] *= b.c[k];
    return a;
  }
};

template <int Dim>
Tile<Dim> tile(const Mat<double, Dim>& A) {
  Tile<Dim> t{};
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) t.c[(a * Dim + b) / lanes][(a * Dim + b) % lanes] = A(a, b);
  return t;
}
template <int Dim>
Mat<double, Dim> matrix(const Tile<Dim>& t) {
  Mat<double, Dim> A;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) A(a, b) = t.c[(a * Dim + b) / lanes][(a * Dim + b) % lanes];
  return A;
}

/// Entry (a, b) is v_a: v ⊗ (1, …, 1).
template <int Dim>
Tile<Dim> in_rows(const Vec<double, Dim>& v) {
  Mat<double, Dim> A;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) A(a, b) = v[a];
  return tile(A);
}
/// Entry (a, b) is v_b, so that in_rows(u) * in_columns(v) = u ⊗ v.
template <int Dim>
Tile<Dim> in_columns(const Vec<double, Dim>& v) {
  if constexpr (Dim == 2) {
#ifdef __AVX__
    typedef double Half __attribute__((vector_size(2 * sizeof(double))));
    return {__builtin_ia32_vbroadcastf128_pd256(reinterpret_cast<const Half*>(v.c))};
#else
    return {Pack{v[0], v[1], v[0], v[1]}};
#endif
  } else {
    Mat<double, Dim> A;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) A(a, b) = v[b];
    return tile(A);
  }
}
/// The first column.
template <int Dim>
Vec<double, Dim> first_column(const Tile<Dim>& t) {
  Vec<double, Dim> v;
  for (int a = 0; a < Dim; ++a) v[a] = t.c[a * Dim / lanes][a * Dim % lanes];
  return v;
}
/// Σ_b of entries (a, b), so that sum_of_columns(A * in_columns(v)) = A v.
template <int Dim>
Vec<double, Dim> sum_of_columns(const Tile<Dim>& t) {
  const Mat<double, Dim> A = matrix(t);
  Vec<double, Dim> v;
  for (int a = 0; a < Dim; ++a) {
    v[a] = A(a, 0);
    for (int b = 1; b < Dim; ++b) v[a] += A(a, b);
  }
  return v;
}

}  // namespace taut::inline TAUT_ISA
