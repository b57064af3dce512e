#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/core/shared_rows.hpp"
#include "engine/core/tensor.hpp"
#include "engine/methods/bonded/layout/setup.hpp"
#include "engine/terms/bond.hpp"

namespace taut {

/// Cancellation on lattices along the axes. The e ⊗ e of diagonals differ only in signs; e: direction of a bond.
template <int Dim>
struct alignas(sizeof(Pack)) CancelledOnLattice {
  static constexpr int faces = Dim == 2 ? 1 : 3;
  struct Face {
    Pack aa, bb, ab;  // e_a², e_b², e_a e_b of the diagonal with e_a e_b > 0
    Pack third[2];    // ⅓ G V0_i w_ij in J; [0]: e_a e_b > 0, [1]: < 0
  };
  struct Across {
    Sym<Pack, 3> dyad;  // e ⊗ e of the diagonal with all e_a e_b > 0
    Pack third[4];      // as in Face; [0]: all e_a e_b > 0; [1], [2], [3]: only e_x e_y, e_x e_z, e_y e_z > 0
  };
  Pack axis[Dim];  // ⅓ G V0_i w_ij of bonds along the axes, in J
  Face face[faces];
  Across across;

  /// Gw = G V0_i w_ij in J. Returns false if the bond does not fit the lattice.
  bool add(int lane, const Sym<double, Dim>& dyad, double Gw);
  /// As CancelledView::slopes.
  Sym<Pack, Dim> slopes(const Sym<Pack, Dim>& C) const;

 private:
  static constexpr std::array<int, 2> plane(int n) { return {n == 2 ? 1 : 0, n == 0 ? 1 : 2}; }
  static bool can_store(Pack& known, int lane, double value) {
    if (known[lane] == 0) known[lane] = value;
    return std::abs(known[lane] - value) < 1e-12;
  }
};

template <int Dim>
bool CancelledOnLattice<Dim>::add(int lane, const Sym<double, Dim>& dyad, double Gw) {
  constexpr double none = 1e-12;
  const auto has_component = [&](int k) { return dyad(k, k) > none; };
  int axes = 0;
  for (int k = 0; k < Dim; ++k) axes += has_component(k);
  for (int k = 0; k < Dim && axes == 1; ++k)
    if (has_component(k)) axis[k][lane] += Gw / 3;
  for (int n = 0; n < faces && axes == 2; ++n) {
    const auto [a, b] = plane(n);
    if (!has_component(a) || !has_component(b)) continue;
    Face& own = face[n];
    own.third[dyad(a, b) > 0 ? 0 : 1][lane] += Gw / 3;
    if (!can_store(own.aa, lane, dyad(a, a)) || !can_store(own.bb, lane, dyad(b, b)) ||
        !can_store(own.ab, lane, std::abs(dyad(a, b))))
      return false;
  }
  if constexpr (Dim == 3) {
    if (axes < 3) return true;
    const bool xy = dyad(0, 1) > 0, xz = dyad(0, 2) > 0;
    across.third[xy ? (xz ? 0 : 1) : (xz ? 2 : 3)][lane] += Gw / 3;
    for (int k = 0; k < dyad.size; ++k)
      if (!can_store(across.dyad.c[k], lane, std::abs(dyad.c[k]))) return false;
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

/// Cancellation of bonds (THEORY.md, Energy). Parallel bonds are merged.
template <int Dim, class Storage = AlignedPack>
struct CancelledView {
  static constexpr int dyad_size = Sym<Pack, Dim>::size - 1;
  /// e ⊗ e of four bonds without its last component (the trace is 1).
  struct Dyad {
    Storage c[dyad_size];
  };
  class Stretch;
  struct GroupRows {
    int dyad, third, count;  // first indices; number of bonds, even
    int on_lattice;          // −1 if off-lattice
  };

  const GroupRows* groups = nullptr;
  const Dyad* dyads = nullptr;
  const Storage* thirds = nullptr;  // ⅓ G V0_i w_ij in J
  const CancelledOnLattice<Dim>* on_lattice = nullptr;

  /// G V0_i Σ_j w_ij φ_c′(λ°)/λ° e ⊗ e for C = Fᵀ F, in J. λ°: stretch of the bond by F alone.
  Sym<Pack, Dim> slopes(int group, const Sym<Pack, Dim>& C) const;
  /// G V0_i Σ_j w_ij φ_c(s°), in J; s° = λ°² = e·C e.
  Pack energy(int group, const Sym<Pack, Dim>& C) const;
};

template <int Dim, class Storage = AlignedPack>
class CancelledBonds {
 public:
  using View = CancelledView<Dim, Storage>;

  CancelledBonds() = default;
  /// `terms_of(i)` must be thread-safe.
  template <class TermsOf>
  CancelledBonds(int n, int threads, const TermsOf& terms_of);

  View view() const { return {groups_.data(), dyads_.from(0), thirds_.from(0), on_lattice_.from(0)}; }

 private:
  static constexpr int dyad_size = View::dyad_size;
  using Dyad = typename View::Dyad;
  struct Direction {
    Sym<double, Dim> dyad;
    double strength;  // G V0_i w_ij in J
  };
  static std::vector<Direction> merged(const std::vector<CancelledTerm>& terms);

  std::vector<typename View::GroupRows> groups_;
  SharedRows<Dyad> dyads_;
  SharedRows<Storage> thirds_;
  SharedRows<CancelledOnLattice<Dim>> on_lattice_;
};

template <int Dim, class Storage>
class CancelledView<Dim, Storage>::Stretch {
 public:
  [[gnu::always_inline]] explicit Stretch(const Sym<Pack, Dim>& C) : factor_(C) {
    constexpr int last = Dim - 1;
#pragma GCC unroll 3
    for (int a = 0; a < last; ++a) {
      factor_(a, a) -= C(last, last);
#pragma GCC unroll 3
      for (int k = a + 1; k < Dim; ++k) factor_(a, k) += C(a, k);
    }
  }
  [[gnu::always_inline]] Pack of(const Dyad& dyad) const {
    Pack s = factor_.c[dyad_size];
#pragma GCC unroll 5
    for (int k = 0; k < dyad_size; ++k) s += factor_.c[k] * unpacked(dyad.c[k]);
    return s;
  }

 private:
  Sym<Pack, Dim> factor_;
};

template <int Dim, class Storage>
Sym<Pack, Dim> CancelledView<Dim, Storage>::slopes(int group, const Sym<Pack, Dim>& C) const {
  const GroupRows& own = groups[group];
  if (own.on_lattice >= 0) return on_lattice[own.on_lattice].slopes(C);
  Sym<Pack, Dim> S{};
  const Stretch stretch(C);
  const Dyad* const dyad = dyads + own.dyad;
  const Storage* const third = thirds + own.third;
  const auto add = [&](const Dyad& of_bond, const Pack& pull) {
#pragma GCC unroll 5
    for (int k = 0; k < dyad_size; ++k) S.c[k] += pull * unpacked(of_bond.c[k]);
    S.c[dyad_size] += pull;
  };
  for (int b = 0; b < own.count; b += 2) {
    const auto [p, q] = cancelled_pulls<Dim>(stretch.of(dyad[b]), stretch.of(dyad[b + 1]), unpacked(third[b]),
                                             unpacked(third[b + 1]));
    add(dyad[b], p);
    add(dyad[b + 1], q);
  }
  for (int k = 0; k < Dim - 1; ++k) S(Dim - 1, Dim - 1) -= S(k, k);
  return S;
}

template <int Dim, class Storage>
Pack CancelledView<Dim, Storage>::energy(int group, const Sym<Pack, Dim>& C) const {
  Pack energy{};
  const Stretch stretch(C);
  const GroupRows& own = groups[group];
  for (int b = 0; b < own.count; ++b)
    energy += unpacked(thirds[own.third + b]) * cancelled_energy<Dim>(stretch.of(dyads[own.dyad + b]));
  return 3 * energy;
}

template <int Dim, class Storage>
auto CancelledBonds<Dim, Storage>::merged(const std::vector<CancelledTerm>& terms) -> std::vector<Direction> {
  std::vector<Direction> all;
  all.reserve(terms.size());
  for (const auto& [X, strength] : terms) {
    double r2 = 0;
    for (int k = 0; k < Dim; ++k) r2 += X[k] * X[k];
    Sym<double, Dim> dyad;
    for (int a = 0; a < Dim; ++a)
      for (int k = a; k < Dim; ++k) dyad(a, k) = X[a] * X[k] / r2;
    const auto same = std::ranges::find_if(all, [&](const Direction& other) {
      double off = 0;
      for (int k = 0; k <= dyad_size; ++k) off = std::max(off, std::abs(dyad.c[k] - other.dyad.c[k]));
      return off < 1e-12;
    });
    if (same == all.end())
      all.push_back({dyad, strength});
    else
      same->strength += strength;
  }
  return all;
}

template <int Dim, class Storage>
template <class TermsOf>
CancelledBonds<Dim, Storage>::CancelledBonds(int n, int threads, const TermsOf& terms_of) {
  struct PackedGroup {
    std::vector<Dyad> dyads;
    std::vector<Storage> thirds;
    CancelledOnLattice<Dim> on_lattice{};
    bool fits = true;
    std::size_t hash_of_dyads = 0, hash_of_thirds = 0;
  };
  const auto make = [&](int group) {
    PackedGroup packed;
    for (int lane = 0; lane < lanes && lanes * group + lane < n; ++lane) {
      const std::vector<Direction> bonds = merged(terms_of(lanes * group + lane));
      const std::size_t count = std::max(packed.dyads.size(), (bonds.size() + 1) / 2 * 2);
      packed.dyads.resize(count), packed.thirds.resize(count);
      for (std::size_t b = 0; b < bonds.size(); ++b) {
        for (int k = 0; k < dyad_size; ++k) packed.dyads[b].c[k].value[lane] = bonds[b].dyad.c[k];
        packed.thirds[b].value[lane] = bonds[b].strength / 3;
        packed.fits = packed.fits && packed.on_lattice.add(lane, bonds[b].dyad, bonds[b].strength);
      }
    }
    packed.hash_of_dyads = dyads_.hash_of(packed.dyads);
    packed.hash_of_thirds = thirds_.hash_of(packed.thirds);
    return packed;
  };
  const int groups = (n + lanes - 1) / lanes;
  dyads_ = SharedRows<Dyad>(groups), thirds_ = SharedRows<Storage>(groups);
  on_lattice_ = SharedRows<CancelledOnLattice<Dim>>(groups);
  make_in_order(groups, threads, make, [&](int, const PackedGroup& packed) {
    groups_.push_back(
        {dyads_.add(packed.dyads, packed.hash_of_dyads), thirds_.add(packed.thirds, packed.hash_of_thirds),
         static_cast<int>(packed.dyads.size()), packed.fits ? on_lattice_.add({packed.on_lattice}) : -1});
  });
  dyads_.close(), thirds_.close(), on_lattice_.close();
}

}  // namespace taut
