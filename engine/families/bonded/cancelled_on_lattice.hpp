#pragma once

#include <array>
#include <cmath>

#include "engine/core/tensor.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

/// The bonds that are cancelled of four particles of lattices along the axes, whose cells may be longer than
/// wide: e ⊗ e of those across one face, and of those across the cell, differ by signs alone, and most of
/// their components are 0.
template <int Dim>
struct CancelledOnLattice {
  static constexpr int faces = Dim == 2 ? 1 : 3;
  struct Face {
    Pack aa, bb, ab;  // e ⊗ e of the diagonal with e_a e_b > 0, in the plane of the axes a < b
    Pack third[2];    // ⅓ G V0_i w_ij, J; of e_a e_b > 0 and < 0
  };
  struct Across {
    Sym<Pack, 3> dyad;  // of the diagonal with all products > 0
    Pack third[4];      // all products > 0; of the others only xy, xz or yz
  };
  Pack axis[Dim];  // ⅓ G V0_i w_ij, J
  Face face[faces];
  Across across;  // in 3D

  /// One more bond of the particle of this lane, which may lie along one that it has but for round-off; false if it
  /// has no place here.
  bool add(int lane, const Sym<double, Dim>& dyad, double Gw);
  /// G V0_i Σ_j w_ij φ′(λ°)/λ° e ⊗ e under C
  Sym<Pack, Dim> slopes(const Sym<Pack, Dim>& C) const;

 private:
  /// The axes of the n-th face.
  static constexpr std::array<int, 2> plane(int n) { return {n == 2 ? 1 : 0, n == 0 ? 1 : 2}; }
  /// Takes the value if there is none yet; is it this one?
  static bool agree(Pack& known, int lane, double value) {
    if (known[lane] == 0) known[lane] = value;
    return std::abs(known[lane] - value) < 1e-12;
  }
};

template <int Dim>
bool CancelledOnLattice<Dim>::add(int lane, const Sym<double, Dim>& dyad, double Gw) {
  constexpr double none = 1e-12;
  const auto along = [&](int k) { return dyad(k, k) > none; };
  int axes = 0;
  for (int k = 0; k < Dim; ++k) axes += along(k);
  for (int k = 0; k < Dim && axes == 1; ++k)
    if (along(k)) axis[k][lane] += Gw / 3;
  for (int n = 0; n < faces && axes == 2; ++n) {
    const auto [a, b] = plane(n);
    if (!along(a) || !along(b)) continue;
    Face& own = face[n];
    own.third[dyad(a, b) > 0 ? 0 : 1][lane] += Gw / 3;
    if (!agree(own.aa, lane, dyad(a, a)) || !agree(own.bb, lane, dyad(b, b)) ||
        !agree(own.ab, lane, std::abs(dyad(a, b))))
      return false;
  }
  if constexpr (Dim == 3) {
    if (axes < 3) return true;
    const bool xy = dyad(0, 1) > 0, xz = dyad(0, 2) > 0;
    across.third[xy ? (xz ? 0 : 1) : (xz ? 2 : 3)][lane] += Gw / 3;
    for (int k = 0; k < dyad.size; ++k)
      if (!agree(across.dyad.c[k], lane, std::abs(dyad.c[k]))) return false;
  }
  return true;
}

template <int Dim>
Sym<Pack, Dim> CancelledOnLattice<Dim>::slopes(const Sym<Pack, Dim>& C) const {
  Sym<Pack, Dim> S{};
  const auto [x, y] = cancelled_pulls<Dim>(C(0, 0), C(1, 1), axis[0], axis[1]);
  S(0, 0) = x, S(1, 1) = y;
  if constexpr (Dim == 3) S(2, 2) = cancelled_pulls<Dim>(C(2, 2), filled<Pack>(1), axis[2], axis[2])[0];
#pragma GCC unroll 3
  for (int n = 0; n < faces; ++n) {
    const auto [a, b] = plane(n);
    const Face& own = face[n];
    const Pack even = own.aa * C(a, a) + own.bb * C(b, b), odd = own.ab * (C(a, b) + C(a, b));
    const auto [p, q] = cancelled_pulls<Dim>(even + odd, even - odd, own.third[0], own.third[1]);
    S(a, a) += (p + q) * own.aa, S(b, b) += (p + q) * own.bb, S(a, b) += (p - q) * own.ab;
  }
  if constexpr (Dim == 3) {
    const Sym<Pack, 3>& e = across.dyad;
    const Pack even = e(0, 0) * C(0, 0) + e(1, 1) * C(1, 1) + e(2, 2) * C(2, 2);
    const Pack xy = e(0, 1) * (C(0, 1) + C(0, 1)), xz = e(0, 2) * (C(0, 2) + C(0, 2)),
               yz = e(1, 2) * (C(1, 2) + C(1, 2));
    const Pack* const third = across.third;
    const auto [p, q] =
        cancelled_pulls<Dim>(even + xy + (xz + yz), even + xy - (xz + yz), third[0], third[1]);
    const auto [r, s] =
        cancelled_pulls<Dim>(even - xy + (xz - yz), even - xy - (xz - yz), third[2], third[3]);
    const Pack all = (p + q) + (r + s);
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) S(k, k) += all * e(k, k);
    S(0, 1) += ((p + q) - (r + s)) * e(0, 1);
    S(0, 2) += ((p - q) + (r - s)) * e(0, 2);
    S(1, 2) += ((p - q) - (r - s)) * e(1, 2);
  }
  return S;
}

}  // namespace taut::inline TAUT_ISA
