#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/tensor.hpp"
#include "engine/core/shared_rows.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

/// What is cancelled of the bonds (terms/bond.hpp), for four particles at once and no neighbour: of an affine
/// displacement all that counts of a bond is its direction, and its stretch is s° = e·C e. Bond after bond of
/// each of the four; two that are each other's continuation are one.
template <int Dim>
class CancelledBonds {
 public:
  /// A bond as seen from one end.
  struct Bond {
    Sym<double, Dim> dyad;  // e ⊗ e
    double Gw;              // G V0_i w_ij, J
  };

  CancelledBonds() = default;
  explicit CancelledBonds(const std::vector<std::vector<Bond>>& of_particle);

  /// G V0_i Σ_j w_ij φ′(λ°)/λ° e ⊗ e of a group under C = Fᵀ F, J
  Sym<Pack, Dim> slopes(int group, const Sym<Pack, Dim>& C) const;
  /// G V0_i Σ_j w_ij φ_c(s°), J
  Pack energy(int group, const Sym<Pack, Dim>& C) const;

 private:
  static constexpr int dyad_size = Sym<Pack, Dim>::size - 1, at_once = 4;
  /// One bond of each of four particles; the filling has Gw = 0. Of e ⊗ e the last component is 1 less the
  /// others of the diagonal.
  struct Four {
    Pack dyad[dyad_size];
    Pack Gw;
  };
  class Stretch;

  static std::vector<Bond> merged(const std::vector<Bond>& bonds);

  struct Group {
    int first, count;  // of its fours
  };
  std::vector<Group> groups_;
  SharedRows<Four> four_;
};

/// s° of bonds: of the components of e ⊗ e that are kept, what C gives them.
template <int Dim>
class CancelledBonds<Dim>::Stretch {
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
  [[gnu::always_inline]] Pack of(const Four& bond) const {
    Pack s = factor_.c[dyad_size];
#pragma GCC unroll 5
    for (int k = 0; k < dyad_size; ++k) s += factor_.c[k] * bond.dyad[k];
    return s;
  }

 private:
  Sym<Pack, Dim> factor_;
};

template <int Dim>
Sym<Pack, Dim> CancelledBonds<Dim>::slopes(int group, const Sym<Pack, Dim>& C) const {
  Sym<Pack, Dim> S{};
  const Stretch stretch(C);
  const auto [first, count] = groups_[group];
  for (int b = first; b < first + count; b += at_once) {
    Pack slope[at_once];
    for (int n = 0; n < at_once; ++n) slope[n] = stretch.of(four_[b + n]);
    take_cancelled_slopes(slope);
    for (int n = 0; n < at_once; ++n) {
      const Four& bond = four_[b + n];
      const Pack pull = bond.Gw * slope[n];
#pragma GCC unroll 5
      for (int k = 0; k < dyad_size; ++k) S.c[k] += pull * bond.dyad[k];
      S.c[dyad_size] += pull;
    }
  }
  for (int k = 0; k < Dim - 1; ++k) S(Dim - 1, Dim - 1) -= S(k, k);
  return S;
}

template <int Dim>
Pack CancelledBonds<Dim>::energy(int group, const Sym<Pack, Dim>& C) const {
  Pack energy{};
  const Stretch stretch(C);
  const auto [first, count] = groups_[group];
  for (int b = first; b < first + count; ++b) energy += four_[b].Gw * cancelled_energy(stretch.of(four_[b]));
  return energy;
}

template <int Dim>
auto CancelledBonds<Dim>::merged(const std::vector<Bond>& bonds) -> std::vector<Bond> {
  std::vector<Bond> all;
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

template <int Dim>
CancelledBonds<Dim>::CancelledBonds(const std::vector<std::vector<Bond>>& of_particle) {
  std::vector<Four> fours;
  for (std::size_t first = 0; first < of_particle.size(); first += lanes) {
    fours.clear();
    for (std::size_t lane = 0; lane < lanes && first + lane < of_particle.size(); ++lane) {
      const std::vector<Bond> bonds = merged(of_particle[first + lane]);
      fours.resize(std::max(fours.size(), bonds.size()));
      for (std::size_t b = 0; b < bonds.size(); ++b) {
        for (int k = 0; k < dyad_size; ++k) fours[b].dyad[k][lane] = bonds[b].dyad.c[k];
        fours[b].Gw[lane] = bonds[b].Gw;
      }
    }
    fours.resize((fours.size() + at_once - 1) / at_once * at_once);
    groups_.push_back({four_.add(fours), static_cast<int>(fours.size())});
  }
  four_.close();
}

}  // namespace taut::inline TAUT_ISA
