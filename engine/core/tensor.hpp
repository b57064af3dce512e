#pragma once

#include <cstddef>

#include "engine/core/pack.hpp"

/// Small vectors and tensors; not Eigen's, whose alignment depends on the instruction set.
namespace taut {

/// Equal in all builds.
template <class T>
inline constexpr std::size_t alignment_of = sizeof(T) == sizeof(Pack) ? sizeof(Pack) : alignof(T);

template <class T, int Dim>
struct Vec {
  alignas(alignment_of<T>) T c[Dim];

  T& operator[](int k) { return c[k]; }
  const T& operator[](int k) const { return c[k]; }

  Vec& operator+=(const Vec& b) {
    for (int k = 0; k < Dim; ++k) c[k] += b[k];
    return *this;
  }
  Vec& operator-=(const Vec& b) {
    for (int k = 0; k < Dim; ++k) c[k] -= b[k];
    return *this;
  }
  friend Vec operator+(Vec a, const Vec& b) { return a += b; }
  friend Vec operator-(Vec a, const Vec& b) { return a -= b; }
  friend Vec operator*(const T& s, Vec a) {
    for (int k = 0; k < Dim; ++k) a[k] *= s;
    return a;
  }
};

template <class T, int Dim>
T dot(const Vec<T, Dim>& a, const Vec<T, Dim>& b) {
  T s = a[0] * b[0];
  for (int k = 1; k < Dim; ++k) s += a[k] * b[k];
  return s;
}

template <class Kept, int Dim>
Vec<Pack, Dim> unpacked(const Vec<Kept, Dim>& a) {
  Vec<Pack, Dim> out;
  for (int k = 0; k < Dim; ++k) out[k] = unpacked(a[k]);
  return out;
}

template <class T>
Vec<T, 3> cross(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T, int Dim>
struct Mat {
  alignas(alignment_of<T>) T c[Dim][Dim];

  T& operator()(int a, int b) { return c[a][b]; }
  const T& operator()(int a, int b) const { return c[a][b]; }

  Mat& operator+=(const Mat& o) {
#pragma GCC unroll 3
    for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
      for (int b = 0; b < Dim; ++b) c[a][b] += o(a, b);
    return *this;
  }
  friend Mat operator+(Mat a, const Mat& b) { return a += b; }
  friend Mat operator*(const T& s, Mat a) {
    for (auto& row : a.c)
      for (T& component : row) component *= s;
    return a;
  }
  friend Vec<T, Dim> operator*(const Mat& a, const Vec<T, Dim>& v) {
    Vec<T, Dim> r;
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) {
      r[k] = a(k, 0) * v[0];
#pragma GCC unroll 3
      for (int l = 1; l < Dim; ++l) r[k] += a(k, l) * v[l];
    }
    return r;
  }
};

/// Upper triangle, row by row.
template <class T, int Dim>
struct Sym {
  static constexpr int size = Dim * (Dim + 1) / 2;
  alignas(alignment_of<T>) T c[size];

  static constexpr int index(int a, int b) {
    return a <= b ? a * Dim - a * (a - 1) / 2 + (b - a) : index(b, a);
  }
  T& operator()(int a, int b) { return c[index(a, b)]; }
  const T& operator()(int a, int b) const { return c[index(a, b)]; }

  Sym& operator+=(const Sym& o) {
#pragma GCC unroll 6
    for (int k = 0; k < size; ++k) c[k] += o.c[k];
    return *this;
  }
  friend Sym operator+(Sym a, const Sym& b) { return a += b; }
  friend Sym operator*(const T& s, Sym a) {
    for (T& component : a.c) component *= s;
    return a;
  }
  friend Vec<T, Dim> operator*(const Sym& a, const Vec<T, Dim>& v) {
    Vec<T, Dim> r;
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) {
      r[k] = a(k, 0) * v[0];
#pragma GCC unroll 3
      for (int l = 1; l < Dim; ++l) r[k] += a(k, l) * v[l];
    }
    return r;
  }
};

template <class T, int Dim>
T trace(const Sym<T, Dim>& a) {
  T s = a(0, 0);
  for (int k = 1; k < Dim; ++k) s += a(k, k);
  return s;
}

template <class T, int Dim>
T trace(const Mat<T, Dim>& A) {
  T s = A(0, 0);
  for (int k = 1; k < Dim; ++k) s += A(k, k);
  return s;
}

template <class T, int Dim>
Sym<T, Dim> right_cauchy_green(const Mat<T, Dim>& F) {
  Sym<T, Dim> C;
#pragma GCC unroll 3
  for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
    for (int b = a; b < Dim; ++b) {
      C(a, b) = F(0, a) * F(0, b);
#pragma GCC unroll 3
      for (int k = 1; k < Dim; ++k) C(a, b) += F(k, a) * F(k, b);
    }
  return C;
}

template <class T, int Dim>
Mat<T, Dim> full(const Sym<T, Dim>& S) {
  Mat<T, Dim> A;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) A(a, b) = S(a, b);
  return A;
}

template <class T, int Dim>
void add_outer(Mat<T, Dim>& A, const T& s, const Vec<T, Dim>& a, const Vec<T, Dim>& b) {
#pragma GCC unroll 3
  for (int k = 0; k < Dim; ++k)
#pragma GCC unroll 3
    for (int l = 0; l < Dim; ++l) A(k, l) += s * a[k] * b[l];
}

template <class T, int Dim>
void add_outer(Sym<T, Dim>& A, const T& s, const Vec<T, Dim>& a) {
#pragma GCC unroll 3
  for (int k = 0; k < Dim; ++k)
#pragma GCC unroll 3
    for (int l = k; l < Dim; ++l) A(k, l) += s * a[k] * a[l];
}

template <class T, int Dim, template <class, int> class Tensor>
[[gnu::always_inline]] inline Mat<T, Dim> product(const Mat<T, Dim>& A, const Tensor<T, Dim>& B) {
  Mat<T, Dim> C;
#pragma GCC unroll 3
  for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
    for (int b = 0; b < Dim; ++b) {
      C(a, b) = A(a, 0) * B(0, b);
#pragma GCC unroll 3
      for (int k = 1; k < Dim; ++k) C(a, b) += A(a, k) * B(k, b);
    }
  return C;
}
template <class T, int Dim>
[[gnu::always_inline]] inline Mat<T, Dim> product_transposed(const Mat<T, Dim>& A, const Mat<T, Dim>& B) {
  Mat<T, Dim> C;
#pragma GCC unroll 3
  for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
    for (int b = 0; b < Dim; ++b) {
      C(a, b) = A(a, 0) * B(b, 0);
#pragma GCC unroll 3
      for (int k = 1; k < Dim; ++k) C(a, b) += A(a, k) * B(b, k);
    }
  return C;
}
template <class T, int Dim>
[[gnu::always_inline]] inline Mat<T, Dim> product_transposed(const Mat<T, Dim>& A, const Sym<T, Dim>& B) {
  return product(A, B);
}

template <class T, int Dim>
[[gnu::always_inline]] inline Mat<T, Dim> product(const Sym<T, Dim>& A, const Sym<T, Dim>& B) {
  Mat<T, Dim> C;
#pragma GCC unroll 3
  for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
    for (int b = 0; b < Dim; ++b) {
      C(a, b) = A(a, 0) * B(0, b);
#pragma GCC unroll 3
      for (int k = 1; k < Dim; ++k) C(a, b) += A(a, k) * B(k, b);
    }
  return C;
}

template <class T, int Dim>
Sym<T, Dim> symmetric_part(const Mat<T, Dim>& A) {
  Sym<T, Dim> S;
  for (int a = 0; a < Dim; ++a)
    for (int b = a; b < Dim; ++b) S(a, b) = 0.5 * (A(a, b) + A(b, a));
  return S;
}

template <class T>
T determinant(const Mat<T, 2>& A) {
  return A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0);
}

/// ∂ det A/∂A
template <class T>
Mat<T, 2> cofactor(const Mat<T, 2>& A) {
  return {{{A(1, 1), -A(1, 0)}, {-A(0, 1), A(0, 0)}}};
}
template <class T>
Mat<T, 3> cofactor(const Mat<T, 3>& A) {
  Mat<T, 3> H;
#pragma GCC unroll 3
  for (int a = 0; a < 3; ++a) {
    const int a1 = (a + 1) % 3, a2 = (a + 2) % 3;
#pragma GCC unroll 3
    for (int b = 0; b < 3; ++b) {
      const int b1 = (b + 1) % 3, b2 = (b + 2) % 3;
      H(a, b) = A(a1, b1) * A(a2, b2) - A(a1, b2) * A(a2, b1);
    }
  }
  return H;
}
template <class T>
T determinant(const Mat<T, 3>& A) {
  return A(0, 0) * (A(1, 1) * A(2, 2) - A(1, 2) * A(2, 1)) +
         A(0, 1) * (A(1, 2) * A(2, 0) - A(1, 0) * A(2, 2)) +
         A(0, 2) * (A(1, 0) * A(2, 1) - A(1, 1) * A(2, 0));
}

/// [A ⨯ B]_iI = ε_ijk ε_IJK A_jJ B_kK: cof F = ½ F ⨯ F. [Lee2016] below Eq. 1
template <class T>
Mat<T, 3> tensor_cross(const Mat<T, 3>& A, const Mat<T, 3>& B) {
  Mat<T, 3> C;
#pragma GCC unroll 3
  for (int a = 0; a < 3; ++a) {
    const int a1 = (a + 1) % 3, a2 = (a + 2) % 3;
#pragma GCC unroll 3
    for (int b = 0; b < 3; ++b) {
      const int b1 = (b + 1) % 3, b2 = (b + 2) % 3;
      C(a, b) = A(a1, b1) * B(a2, b2) - A(a1, b2) * B(a2, b1) + A(a2, b2) * B(a1, b1) - A(a2, b1) * B(a1, b2);
    }
  }
  return C;
}

/// Inverse of a positive semidefinite tensor; 0 if nearly singular.
inline Sym<double, 2> inverse(const Sym<double, 2>& a) {
  const double det = a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1);
  const double scale = trace(a) * trace(a);
  if (!(det > 1e-12 * scale)) return {};
  return (1 / det) * Sym<double, 2>{a(1, 1), -a(0, 1), a(0, 0)};
}
inline Sym<double, 3> inverse(const Sym<double, 3>& a) {
  const Mat<double, 3> H = cofactor(full(a));
  const double det = a(0, 0) * H(0, 0) + a(0, 1) * H(0, 1) + a(0, 2) * H(0, 2);
  const double scale = trace(a) * trace(a) * trace(a);
  if (!(det > 1e-12 * scale)) return {};
  return (1 / det) * Sym<double, 3>{H(0, 0), H(0, 1), H(0, 2), H(1, 1), H(1, 2), H(2, 2)};
}

template <int Dim>
Vec<double, Dim> sum(const Vec<Pack, Dim>& a) {
  const Pack of_all = sums(a[0], a[1], a[Dim - 2], a[Dim - 1]);
  Vec<double, Dim> r;
  r[0] = of_all[0], r[1] = of_all[1];
  if constexpr (Dim == 3) r[2] = of_all[3];
  return r;
}
template <int n>
void sums(const Pack* a, double* r) {
  constexpr int fours = n / lanes * lanes;
  for (int k = 0; k < fours; k += lanes) {
    const Pack of_four = sums(a[k], a[k + 1], a[k + 2], a[k + 3]);
    for (int l = 0; l < lanes; ++l) r[k + l] = of_four[l];
  }
  if constexpr (n - fours > 1) {
    const Pack rest = sums(a[fours], a[fours + 1], a[n - 1], a[n - 1]);
    for (int l = 0; l < n - fours; ++l) r[fours + l] = rest[l];
  } else if constexpr (n > fours) {
    r[fours] = sum(a[fours]);
  }
}
template <int Dim>
Mat<double, Dim> sum(const Mat<Pack, Dim>& a) {
  Mat<double, Dim> r;
  sums<Dim * Dim>(a.c[0], r.c[0]);
  return r;
}
template <int Dim>
Sym<double, Dim> sum(const Sym<Pack, Dim>& a) {
  Sym<double, Dim> r;
  sums<Sym<double, Dim>::size>(a.c, r.c);
  return r;
}

template <int Dim>
Vec<double, Dim> lane_of(const Vec<Pack, Dim>& a, int lane) {
  Vec<double, Dim> one;
  for (int k = 0; k < Dim; ++k) one[k] = a[k][lane];
  return one;
}
template <int Dim>
void set_lane(Vec<Pack, Dim>& a, int lane, const Vec<double, Dim>& one) {
  for (int k = 0; k < Dim; ++k) a[k][lane] = one[k];
}
template <int Dim>
Mat<double, Dim> lane_of(const Mat<Pack, Dim>& A, int lane) {
  Mat<double, Dim> one;
  for (int k = 0; k < Dim; ++k)
    for (int l = 0; l < Dim; ++l) one(k, l) = A(k, l)[lane];
  return one;
}
template <int Dim>
void set_lane(Mat<Pack, Dim>& A, int lane, const Mat<double, Dim>& one) {
  for (int k = 0; k < Dim; ++k)
    for (int l = 0; l < Dim; ++l) A(k, l)[lane] = one(k, l);
}
inline void take_lane(Pack& a, int lane, const Pack& other) { a[lane] = other[lane]; }
template <int Dim>
void take_lane(Mat<Pack, Dim>& A, int lane, const Mat<Pack, Dim>& other) {
  set_lane(A, lane, lane_of(other, lane));
}

template <int Dim>
Vec<Pack, Dim> spread(const Vec<double, Dim>& a) {
  Vec<Pack, Dim> r;
  for (int k = 0; k < Dim; ++k) r[k] = filled<Pack>(a[k]);
  return r;
}
template <int Dim>
Mat<Pack, Dim> spread(const Mat<double, Dim>& a) {
  Mat<Pack, Dim> r;
  for (int k = 0; k < Dim; ++k)
    for (int l = 0; l < Dim; ++l) r(k, l) = filled<Pack>(a(k, l));
  return r;
}

}  // namespace taut
