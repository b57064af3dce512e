#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/core/point.hpp"
#include "engine/core/shared_rows.hpp"
#include "engine/core/tensor.hpp"
#include "engine/families/bonded/cancelled_on_lattice.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

/// What is cancelled of the bonds (terms/bond.hpp), for four particles at once and no neighbour: of an affine
/// displacement all that counts of a bond is its direction, and its stretch is s° = e·C e. Bond after bond of
/// each of the four; two that are each other's continuation are one. Kept as those of PackedBonds.
template <int Dim, class Kept = StoredPack>
class CancelledBonds {
 public:
  /// A bond as seen from one end.
  struct Bond {
    Sym<double, Dim> dyad;  // e ⊗ e
    double Gw;              // G V0_i w_ij, J
  };

  /// One along X.
  static Bond along(const Point& X, double Gw) {
    double r2 = 0;
    for (int k = 0; k < Dim; ++k) r2 += X[k] * X[k];
    Bond bond{{}, Gw};
    for (int a = 0; a < Dim; ++a)
      for (int k = a; k < Dim; ++k) bond.dyad(a, k) = X[a] * X[k] / r2;
    return bond;
  }

  CancelledBonds() = default;
  /// Of particle i < n those that bonds_of(i) gives, a vector of Bond; it is called on `threads` threads.
  template <class BondsOf>
  CancelledBonds(int n, int threads, const BondsOf& bonds_of);

  /// G V0_i Σ_j w_ij φ′(λ°)/λ° e ⊗ e of a group under C = Fᵀ F, J
  Sym<Pack, Dim> slopes(int group, const Sym<Pack, Dim>& C) const;
  /// G V0_i Σ_j w_ij φ_c(s°), J
  Pack energy(int group, const Sym<Pack, Dim>& C) const;

 private:
  static constexpr int dyad_size = Sym<Pack, Dim>::size - 1;
  /// Of one bond of each of four particles e ⊗ e, but for the last component: 1 less the others of the
  /// diagonal.
  struct Dyad {
    Kept c[dyad_size];
  };
  class Stretch;

  static std::vector<Bond> merged(const std::vector<Bond>& bonds);

  struct Group {
    int dyad, third, count;  // where its bonds begin; they are filled up to pairs with what has no strength
    int on_lattice;          // −1 if they are not
  };
  std::vector<Group> groups_;
  SharedRows<Dyad> dyads_;
  SharedRows<Kept> thirds_;  // ⅓ G V0_i w_ij, J
  SharedRows<CancelledOnLattice<Dim>> on_lattice_;
};

/// s° of bonds: of the components of e ⊗ e that are kept, what C gives them.
template <int Dim, class Kept>
class CancelledBonds<Dim, Kept>::Stretch {
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

template <int Dim, class Kept>
Sym<Pack, Dim> CancelledBonds<Dim, Kept>::slopes(int group, const Sym<Pack, Dim>& C) const {
  const Group& own = groups_[group];
  if (own.on_lattice >= 0) return on_lattice_[own.on_lattice].slopes(C);
  Sym<Pack, Dim> S{};
  const Stretch stretch(C);
  const Dyad* const dyads = &dyads_[own.dyad];
  const Kept* const thirds = &thirds_[own.third];
  const auto add = [&](const Dyad& dyad, const Pack& pull) {
#pragma GCC unroll 5
    for (int k = 0; k < dyad_size; ++k) S.c[k] += pull * unpacked(dyad.c[k]);
    S.c[dyad_size] += pull;
  };
  for (int b = 0; b < own.count; b += 2) {
    const auto [p, q] = cancelled_pulls<Dim>(stretch.of(dyads[b]), stretch.of(dyads[b + 1]),
                                             unpacked(thirds[b]), unpacked(thirds[b + 1]));
    add(dyads[b], p);
    add(dyads[b + 1], q);
  }
  for (int k = 0; k < Dim - 1; ++k) S(Dim - 1, Dim - 1) -= S(k, k);
  return S;
}

template <int Dim, class Kept>
Pack CancelledBonds<Dim, Kept>::energy(int group, const Sym<Pack, Dim>& C) const {
  Pack energy{};
  const Stretch stretch(C);
  const Group& own = groups_[group];
  for (int b = 0; b < own.count; ++b)
    energy += unpacked(thirds_[own.third + b]) * cancelled_energy<Dim>(stretch.of(dyads_[own.dyad + b]));
  return 3 * energy;
}

template <int Dim, class Kept>
auto CancelledBonds<Dim, Kept>::merged(const std::vector<Bond>& bonds) -> std::vector<Bond> {
  std::vector<Bond> all;
  all.reserve(bonds.size());
  for (const Bond& one : bonds) {
    const auto same = std::ranges::find_if(all, [&](const Bond& other) {
      double off = 0;
      for (int k = 0; k <= dyad_size; ++k) off = std::max(off, std::abs(one.dyad.c[k] - other.dyad.c[k]));
      return off < 1e-12;
    });
    if (same == all.end())
      all.push_back(one);
    else
      same->Gw += one.Gw;
  }
  return all;
}

template <int Dim, class Kept>
template <class BondsOf>
CancelledBonds<Dim, Kept>::CancelledBonds(int n, int threads, const BondsOf& bonds_of) {
  struct Four {
    std::vector<Dyad> dyads;
    std::vector<Kept> thirds;
    CancelledOnLattice<Dim> on_lattice{};
    bool fits = true;
    std::size_t hash_of_dyads = 0, hash_of_thirds = 0;
  };
  const auto make = [&](int group) {
    Four four;
    for (int lane = 0; lane < lanes && lanes * group + lane < n; ++lane) {
      const std::vector<Bond> bonds = merged(bonds_of(lanes * group + lane));
      const std::size_t count = std::max(four.dyads.size(), (bonds.size() + 1) / 2 * 2);
      four.dyads.resize(count), four.thirds.resize(count);
      for (std::size_t b = 0; b < bonds.size(); ++b) {
        for (int k = 0; k < dyad_size; ++k) four.dyads[b].c[k].value[lane] = bonds[b].dyad.c[k];
        four.thirds[b].value[lane] = bonds[b].Gw / 3;
        four.fits = four.fits && four.on_lattice.add(lane, bonds[b].dyad, bonds[b].Gw);
      }
    }
    four.hash_of_dyads = dyads_.hash_of(four.dyads), four.hash_of_thirds = thirds_.hash_of(four.thirds);
    return four;
  };
  const int groups = (n + lanes - 1) / lanes;
  dyads_ = SharedRows<Dyad>(groups), thirds_ = SharedRows<Kept>(groups);
  on_lattice_ = SharedRows<CancelledOnLattice<Dim>>(groups);
  make_in_order(groups, threads, make, [&](int, const Four& four) {
    groups_.push_back({dyads_.add(four.dyads, four.hash_of_dyads),
                       thirds_.add(four.thirds, four.hash_of_thirds), static_cast<int>(four.dyads.size()),
                       four.fits ? on_lattice_.add({four.on_lattice}) : -1});
  });
  dyads_.close(), thirds_.close(), on_lattice_.close();
}

}  // namespace taut::inline TAUT_ISA
