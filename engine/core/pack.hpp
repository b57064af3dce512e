#pragma once

#include <cmath>
#include <type_traits>

#include "engine/core/isa.hpp"

namespace taut::inline TAUT_ISA {

/// Four doubles that are worked on at once: four neighbours of one particle, or one of each of four. A vector type of the compiler,
/// so that arithmetic, comparison and `mask ? a : b` read as for a double, and a term written for T serves
/// both. Without AVX it is two SSE2 halves with the same results to the last bit.
inline constexpr int lanes = 4;
typedef double Pack __attribute__((vector_size(lanes * sizeof(double))));
typedef long long PackIndex __attribute__((vector_size(lanes * sizeof(long long))));

/// Four doubles that stand one behind the other, on any boundary.
typedef double UnalignedPack __attribute__((vector_size(lanes * sizeof(double)), aligned(sizeof(double))));
inline Pack load(const double* from) { return *reinterpret_cast<const UnalignedPack*>(from); }
/// The first `count` of them, and 0.
inline Pack load(const double* from, int count) {
  Pack a{};
  for (int lane = 0; lane < lanes && lane < count; ++lane) a[lane] = from[lane];
  return a;
}
inline void store(const Pack& a, double* to) { *reinterpret_cast<UnalignedPack*>(to) = a; }

/// A Pack in a std::vector. Vectors of the bare type would be one type for all builds of the solver, and the
/// linker would let the one without AVX, for which a Pack is less aligned, make room for the others.
struct StoredPack {
  alignas(lanes * sizeof(double)) Pack value;
};

inline double sum(const Pack& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

/// sum(a), sum(b), sum(c), sum(d)
inline Pack sums(const Pack& a, const Pack& b, const Pack& c, const Pack& d) {
#ifdef __AVX__
  const Pack ab = __builtin_ia32_haddpd256(a, b), cd = __builtin_ia32_haddpd256(c, d);
#else
  const Pack ab{a[0] + a[1], b[0] + b[1], a[2] + a[3], b[2] + b[3]};
  const Pack cd{c[0] + c[1], d[0] + d[1], c[2] + c[3], d[2] + d[3]};
#endif
  return __builtin_shuffle(ab, cd, PackIndex{0, 1, 4, 5}) + __builtin_shuffle(ab, cd, PackIndex{2, 3, 6, 7});
}

inline Pack root(const Pack& a) {
#ifdef __AVX__
  return __builtin_ia32_sqrtpd256(a);
#else
  return Pack{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}
inline double root(double a) { return std::sqrt(a); }

template <class T>
T min(const T& a, const T& b) {
  return a < b ? a : b;
}
template <class T>
T max(const T& a, const T& b) {
  return a > b ? a : b;
}
#ifdef __AVX__
// one instruction each, of the same result to the last bit, for NaN too
inline Pack min(const Pack& a, const Pack& b) { return __builtin_ia32_minpd256(a, b); }
inline Pack max(const Pack& a, const Pack& b) { return __builtin_ia32_maxpd256(a, b); }
#endif
/// The greater, NaN if any of the two is.
inline Pack max_or_nan(const Pack& a, const Pack& b) { return (b <= a) | (a != a) ? a : b; }
/// NaN if any is.
inline double greatest(const Pack& a) {
  double most = a[0];
  for (int lane = 1; lane < lanes; ++lane)
    if (!(a[lane] <= most || most != most)) most = a[lane];
  return most;
}

template <int N, class T>
T power(const T& a) {
  T r = a;
  for (int k = 1; k < N; ++k) r *= a;
  return r;
}
template <class T>
T filled(double value) {
  if constexpr (std::is_same_v<T, Pack>)
    return Pack{value, value, value, value};
  else
    return value;
}

/// Of a comparison.
inline bool any(bool a) { return a; }
inline bool any(const PackIndex& a) {
#ifdef __AVX__
  return __builtin_ia32_movmskpd256((Pack)a) != 0;
#else
  return (a[0] | a[1] | a[2] | a[3]) != 0;
#endif
}

/// Rows j[0…3] of a table with `Width` doubles a row (a multiple of 4, rows aligned to 32 bytes), transposed:
/// out[k] holds column k of the four rows. With `Stride` > Width only the first columns of a wider table.
template <int Width, int Stride = Width>
inline void gather(const double* table, const int* j, Pack* out) {
  static_assert(Width % lanes == 0 && Stride % lanes == 0);
  for (int k = 0; k < Width; k += lanes) {
    const Pack a = *reinterpret_cast<const Pack*>(table + std::ptrdiff_t{j[0]} * Stride + k);
    const Pack b = *reinterpret_cast<const Pack*>(table + std::ptrdiff_t{j[1]} * Stride + k);
    const Pack c = *reinterpret_cast<const Pack*>(table + std::ptrdiff_t{j[2]} * Stride + k);
    const Pack d = *reinterpret_cast<const Pack*>(table + std::ptrdiff_t{j[3]} * Stride + k);
    const Pack ab_even = __builtin_shuffle(a, b, PackIndex{0, 4, 2, 6});
    const Pack ab_odd = __builtin_shuffle(a, b, PackIndex{1, 5, 3, 7});
    const Pack cd_even = __builtin_shuffle(c, d, PackIndex{0, 4, 2, 6});
    const Pack cd_odd = __builtin_shuffle(c, d, PackIndex{1, 5, 3, 7});
    out[k] = __builtin_shuffle(ab_even, cd_even, PackIndex{0, 1, 4, 5});
    out[k + 1] = __builtin_shuffle(ab_odd, cd_odd, PackIndex{0, 1, 4, 5});
    out[k + 2] = __builtin_shuffle(ab_even, cd_even, PackIndex{2, 3, 6, 7});
    out[k + 3] = __builtin_shuffle(ab_odd, cd_odd, PackIndex{2, 3, 6, 7});
  }
}

/// The reverse: row n of the four from `row` on holds in[0][n], in[1][n], …
template <int Width>
inline void scatter(const Pack* in, double* row) {
  static_assert(Width % lanes == 0);
  for (int k = 0; k < Width; k += lanes) {
    const Pack ab_even = __builtin_shuffle(in[k], in[k + 1], PackIndex{0, 4, 2, 6});
    const Pack ab_odd = __builtin_shuffle(in[k], in[k + 1], PackIndex{1, 5, 3, 7});
    const Pack cd_even = __builtin_shuffle(in[k + 2], in[k + 3], PackIndex{0, 4, 2, 6});
    const Pack cd_odd = __builtin_shuffle(in[k + 2], in[k + 3], PackIndex{1, 5, 3, 7});
    Pack* const at = reinterpret_cast<Pack*>(row + k);
    at[0] = __builtin_shuffle(ab_even, cd_even, PackIndex{0, 1, 4, 5});
    at[Width / lanes] = __builtin_shuffle(ab_odd, cd_odd, PackIndex{0, 1, 4, 5});
    at[2 * Width / lanes] = __builtin_shuffle(ab_even, cd_even, PackIndex{2, 3, 6, 7});
    at[3 * Width / lanes] = __builtin_shuffle(ab_odd, cd_odd, PackIndex{2, 3, 6, 7});
  }
}

}  // namespace taut::inline TAUT_ISA
