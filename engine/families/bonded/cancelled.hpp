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
/// each of the four; two that are each other's continuation are one. What is cancelled of areas at faces
/// (face_terms.hpp) is ψ of s° = e·(cof C) e. Kept as those of PackedBonds.
template <int Dim, class Kept = StoredPack>
class CancelledBonds {
 public:
  /// A bond as seen from one end.
  struct Bond {
    Sym<double, Dim> dyad;  // e ⊗ e
    double Gw;              // G V0_i w_ij, J
    bool across = false;    // of the area across e; in 3D
  };

  /// One along X, or across it.
  static Bond along(const Point& X, double Gw, bool across = false) {
    double r2 = 0;
    for (int k = 0; k < Dim; ++k) r2 += X[k] * X[k];
    Bond bond{{}, Gw, across};
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

  static std::vector<Bond> merged(const std::vector<Bond>& bonds, bool across);
  /// N ⨯ C of an area with N = e ⊗ e: twice e·(cof C) e is its product with C, and itself the slope of that once.
  static Sym<Pack, Dim> of_area(const Dyad& dyad, const Sym<Pack, Dim>& C);

  struct Row {
    int dyad, third, count;  // where its bonds begin; they are filled up to pairs with what has no strength
  };
  struct Group {
    Row bonds, areas;
    int on_lattice;  // −1 if its bonds are not
  };
  Sym<Pack, Dim> of_bonds(const Row& own, const Sym<Pack, Dim>& C) const;

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
  Sym<Pack, Dim> S = own.on_lattice >= 0 ? on_lattice_[own.on_lattice].slopes(C) : of_bonds(own.bonds, C);
  if constexpr (Dim == 3)
    for (int b = 0; b < own.areas.count; ++b) {
      const Sym<Pack, Dim> D = of_area(dyads_[own.areas.dyad + b], C);
      const Pack s = 0.5 * contraction(D, C), third = unpacked(thirds_[own.areas.third + b]);
      S += (3 * third * area_slope(s)) * D;
    }
  return S;
}

template <int Dim, class Kept>
Sym<Pack, Dim> CancelledBonds<Dim, Kept>::of_bonds(const Row& own, const Sym<Pack, Dim>& C) const {
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
    const auto [p, q] = cancelled_pulls(stretch.of(dyads[b]), stretch.of(dyads[b + 1]), unpacked(thirds[b]),
                                        unpacked(thirds[b + 1]));
    add(dyads[b], p);
    add(dyads[b + 1], q);
  }
  for (int k = 0; k < Dim - 1; ++k) S(Dim - 1, Dim - 1) -= S(k, k);
  return S;
}

template <int Dim, class Kept>
Sym<Pack, Dim> CancelledBonds<Dim, Kept>::of_area(const Dyad& dyad, const Sym<Pack, Dim>& C) {
  Sym<Pack, Dim> N;
  N.c[dyad_size] = filled<Pack>(1);
  for (int k = 0; k < dyad_size; ++k) N.c[k] = unpacked(dyad.c[k]);
  for (int k = 0; k < Dim - 1; ++k) N(Dim - 1, Dim - 1) -= N(k, k);
  return tensor_cross(N, C);
}

template <int Dim, class Kept>
Pack CancelledBonds<Dim, Kept>::energy(int group, const Sym<Pack, Dim>& C) const {
  Pack energy{};
  const Stretch stretch(C);
  const auto& [bonds, areas, on_lattice] = groups_[group];
  for (int b = 0; b < bonds.count; ++b)
    energy += unpacked(thirds_[bonds.third + b]) * cancelled_energy(stretch.of(dyads_[bonds.dyad + b]));
  if constexpr (Dim == 3)
    for (int b = 0; b < areas.count; ++b) {
      const Pack s = 0.5 * contraction(of_area(dyads_[areas.dyad + b], C), C);
      energy += unpacked(thirds_[areas.third + b]) * area_energy(s);
    }
  return 3 * energy;
}

template <int Dim, class Kept>
auto CancelledBonds<Dim, Kept>::merged(const std::vector<Bond>& bonds, bool across) -> std::vector<Bond> {
  std::vector<Bond> all;
  for (const Bond& one : bonds) {
    if (one.across != across) continue;
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
  struct Constants {
    std::vector<Dyad> dyads;
    std::vector<Kept> thirds;

    void put(int lane, const std::vector<Bond>& bonds, std::size_t size) {
      const std::size_t count = std::max(dyads.size(), size);
      dyads.resize(count), thirds.resize(count);
      for (std::size_t b = 0; b < bonds.size(); ++b) {
        for (int k = 0; k < dyad_size; ++k) dyads[b].c[k].value[lane] = bonds[b].dyad.c[k];
        thirds[b].value[lane] = bonds[b].Gw / 3;
      }
    }
  };
  struct Four {
    Constants bonds, areas;
    CancelledOnLattice<Dim> on_lattice{};
    bool fits = true;
  };
  const auto make = [&](int group) {
    Four four;
    for (int lane = 0; lane < lanes && lanes * group + lane < n; ++lane) {
      const std::vector<Bond> all = bonds_of(lanes * group + lane), bonds = merged(all, false),
                              areas = merged(all, true);
      four.bonds.put(lane, bonds, (bonds.size() + 1) / 2 * 2);
      four.areas.put(lane, areas, areas.size());
      for (const Bond& bond : bonds) four.fits = four.fits && four.on_lattice.add(lane, bond.dyad, bond.Gw);
    }
    return four;
  };
  const int groups = (n + lanes - 1) / lanes;
  dyads_ = SharedRows<Dyad>(groups), thirds_ = SharedRows<Kept>(groups);
  on_lattice_ = SharedRows<CancelledOnLattice<Dim>>(groups);
  const auto add = [&](const Constants& row) -> Row {
    return {dyads_.add(row.dyads), thirds_.add(row.thirds), static_cast<int>(row.dyads.size())};
  };
  make_in_order(groups, threads, make, [&](int, const Four& four) {
    groups_.push_back(
        {add(four.bonds), add(four.areas), four.fits ? on_lattice_.add({four.on_lattice}) : -1});
  });
  dyads_.close(), thirds_.close(), on_lattice_.close();
}

}  // namespace taut::inline TAUT_ISA
