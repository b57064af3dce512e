#pragma once

#include <cmath>
#include <type_traits>

namespace taut {

/// Results are bit-identical with and without AVX.
inline constexpr int lanes = 4;
typedef double Pack __attribute__((vector_size(lanes * sizeof(double))));
typedef long long PackIndex __attribute__((vector_size(lanes * sizeof(long long))));

/// Factor 1: the caller applies the actual factor elsewhere.
inline constexpr Pack one = {1, 1, 1, 1};

typedef double UnalignedPack __attribute__((vector_size(lanes * sizeof(double)), aligned(sizeof(double))));
inline Pack load(const double* from) { return *reinterpret_cast<const UnalignedPack*>(from); }
/// Other lanes are 0.
inline Pack load(const double* from, int count) {
  Pack a{};
  for (int lane = 0; lane < lanes && lane < count; ++lane) a[lane] = from[lane];
  return a;
}
inline void store(const Pack& a, double* to) { *reinterpret_cast<UnalignedPack*>(to) = a; }

/// Without AVX, GCC aligns a bare Pack to fewer than 32 bytes.
struct AlignedPack {
  alignas(lanes * sizeof(double)) Pack value;
};

/// Relative error 6e-8 from 1e-37 to 1e38.
struct HalfPack {
  typedef float Floats __attribute__((vector_size(lanes * sizeof(float))));
  alignas(lanes * sizeof(float)) Floats value;
};

inline Pack unpacked(const AlignedPack& a) { return a.value; }
inline Pack unpacked(const HalfPack& a) { return __builtin_convertvector(a.value, Pack); }
inline void pack_into(AlignedPack& to, const Pack& a) { to.value = a; }
inline void pack_into(HalfPack& to, const Pack& a) {
  to.value = __builtin_convertvector(a, HalfPack::Floats);
}

inline double sum(const Pack& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

inline Pack sums(const Pack& a, const Pack& b, const Pack& c, const Pack& d) {
#ifdef __AVX__
  const Pack ab = __builtin_ia32_haddpd256(a, b), cd = __builtin_ia32_haddpd256(c, d);
#else
  const Pack ab{a[0] + a[1], b[0] + b[1], a[2] + a[3], b[2] + b[3]};
  const Pack cd{c[0] + c[1], d[0] + d[1], c[2] + c[3], d[2] + d[3]};
#endif
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
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
// bit-identical to the templates, also for NaN
inline Pack min(const Pack& a, const Pack& b) { return __builtin_ia32_minpd256(a, b); }
inline Pack max(const Pack& a, const Pack& b) { return __builtin_ia32_maxpd256(a, b); }
#endif
/// Maximum; NaN if either is NaN.
inline Pack max_or_nan(const Pack& a, const Pack& b) { return ((b <= a) | (a != a)) ? a : b; }
/// NaN if any lane is NaN.
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
/// aⁿ for n ≥ 0; a library call would spill a loop's registers.
inline Pack power(const Pack& a, double n) {
  if (n == 4) return (a * a) * (a * a);
  const auto whole = static_cast<unsigned>(n);
  Pack result = Pack{1, 1, 1, 1}, square = a, part = a;
  for (unsigned bits = whole; bits != 0; bits >>= 1) {
    if (bits & 1) result *= square;
    square *= square;
  }
  for (double rest = n - whole; rest > 0; rest -= rest >= 1) {
    part = root(part);
    rest *= 2;
    if (rest >= 1) result *= part;
  }
  return result;
}
template <class T>
T filled(double value) {
  if constexpr (std::is_same_v<T, Pack>)
    return Pack{value, value, value, value};
  else
    return value;
}

/// Bit l is the result in lane l.
inline unsigned lanes_where(const PackIndex& a) {
#ifdef __AVX__
  return static_cast<unsigned>(__builtin_ia32_movmskpd256((Pack)a));
#else
  return static_cast<unsigned>((a[0] & 1) | (a[1] & 2) | (a[2] & 4) | (a[3] & 8));
#endif
}
inline bool any(bool a) { return a; }
inline bool any(const PackIndex& a) { return lanes_where(a) != 0; }

inline Pack halves(const double* a, const double* b) {
  typedef double Half __attribute__((vector_size(2 * sizeof(double))));
  const Half &low = *reinterpret_cast<const Half*>(a), &high = *reinterpret_cast<const Half*>(b);
#if defined(__AVX__) && !defined(__clang__)
  // GCC 12 turns a shuffle into several moves
  return __builtin_ia32_vinsertf128_pd256(__builtin_ia32_pd256_pd(low), high, 1);
#else
  return __builtin_shufflevector(low, high, 0, 1, 2, 3);
#endif
}

/// Columns of four rows. Each row is aligned to 16 bytes and has an even number of doubles.
struct RowsOfFour {
  const double* at[lanes];

  [[gnu::always_inline]] RowsOfFour(const double* table, std::ptrdiff_t stride, const int* j)
      : at{table + j[0] * stride, table + j[1] * stride, table + j[2] * stride, table + j[3] * stride} {}

  [[gnu::always_inline]] Pack column(int k) const {
    const int even = k / 2 * 2;
    const Pack ac = halves(at[0] + even, at[2] + even), bd = halves(at[1] + even, at[3] + even);
    return k == even ? __builtin_shufflevector(ac, bd, 0, 4, 2, 6)
                     : __builtin_shufflevector(ac, bd, 1, 5, 3, 7);
  }
};

/// Transposes the first `Columns` doubles of rows j[0…3].
template <int Columns, int Stride = Columns>
[[gnu::always_inline]] inline void gather(const double* table, const int* j, Pack* out) {
  static_assert(Stride % 2 == 0);
  const RowsOfFour rows(table, Stride, j);
#pragma GCC unroll 16
  for (int k = 0; k < Columns; ++k) out[k] = rows.column(k);
}

}  // namespace taut
