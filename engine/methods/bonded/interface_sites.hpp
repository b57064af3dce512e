#pragma once

#include <cmath>
#include <vector>

#include "engine/core/columns.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/tensor.hpp"
#include "engine/methods/bonded/closed_law.hpp"
#include "engine/methods/bonded/layout/interfaces.hpp"
#include "engine/methods/bonded/layout/setup.hpp"
#include "engine/methods/bonded/packed_bonds.hpp"
#include "engine/terms/bond.hpp"

namespace taut {

/// W and ∂W/∂F of one particle.
struct LawOfOne {
  const std::vector<Elasticity>& materials;
  bool own;  // uses the default law
  const Materials& chosen;

  template <int Dim>
  double energy(int material, const Mat<double, Dim>& F) const {
    if (own) return ClosedNeoHookean<double>{materials[material].K, materials[material].G}.energy(F);
    return chosen.visit(material, [&](const auto& law) { return closed_energy(law, F); });
  }
  template <int Dim>
  Mat<double, Dim> piola(int material, const Mat<double, Dim>& F) const {
    if (own) return ClosedNeoHookean<double>{materials[material].K, materials[material].G}.piola(F);
    return chosen.visit(material, [&](const auto& law) { return closed_piola(law, F); });
  }
};

/// Particles beside another material (THEORY.md, Interfaces).
template <int Dim>
class InterfaceSites {
 public:
  using Direction = Vec<double, Dim>;
  using Square = Mat<double, Dim>;

  InterfaceSites() = default;
  /// `ids` is in storage order.
  InterfaceSites(const BondedSetup& setup, const std::vector<int>& ids);

  /// Replaces Q at the sites and adds the forces of kinks and of bonds across the interface, N.
  template <class Column, class Law>
  void pass(const Column& x, const Law& law, int threads, Columns<Dim * Dim>& Q,
            std::vector<Vec<Pack, Dim>>& bond_force);
  /// Energy of particle i minus its energy without the interface terms, J.
  template <class Column, class Law>
  double energy_of_kink(int i, const Column& x, const Law& law) const;

 private:
  struct StoredSiteBond {
    int j;
    Direction g, e;                 // 1/m; initial direction
    double per_r0_squared;          // 1/m²
    double strength, own_strength;  // J, see SiteBond
    int pull;                       // in pulls_, or −1
  };
  struct Kink {
    int j;
    double weight;  // β_ij, 1/m
  };
  struct StoredSite {
    int i, own, other;  // stored index; materials
    double V, share;    // m^Dim; θ
    Direction N, m;     // see THEORY.md
    Square B;
    int bond, bonds, kink, kinks;  // ranges [bond, bonds) in bonds_, [kink, kinks) in kinks_
  };
  /// `across`: F_own − ½ b ⊗ N, in the middle of a bond across the interface.
  struct Deformations {
    Square mean, own, other, across;
  };
  struct PullShare {
    int pull, lane;
    double weight;
  };
  struct GroupShares {
    int group, begin, end;
  };
  /// Energy of a bond across the interface, J, and its derivatives by s, s°(F_across) and s°(F_own).
  struct AcrossEnergy {
    double energy, of_s, of_across, of_own;
  };

  template <class Column, class Law>
  Square stress(int site, const Column& x, const Law& law);
  template <class Column>
  Deformations deformations(const StoredSite& site, const Column& x) const;
  static Square with(const Square& F, double share, const Direction& b, const Direction& n) {
    Square sum = F;
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) sum(a, k) += share * b[a] * n[k];
    return sum;
  }
  static AcrossEnergy energy_across(const StoredSiteBond& bond, double s, double across, double own);
  void share_out();

  std::vector<StoredSite> sites_;
  std::vector<int> site_of_;  // [stored] or −1
  std::vector<StoredSiteBond> bonds_;
  std::vector<Kink> kinks_;
  std::vector<Direction> pulls_;  // ∂E/∂b of each site, J; then forces of bonds across the interface, N
  std::vector<PullShare> shares_;
  std::vector<GroupShares> affected_;
};

template <int Dim>
InterfaceSites<Dim>::InterfaceSites(const BondedSetup& setup, const std::vector<int>& ids) {
  const InitialParticles& initial = setup.initial;
  const Bonds& bonds = setup.bonds;
  const Interfaces& interfaces = setup.interfaces;
  const std::vector<int> where = stored_places(ids);
  const auto vector = [](const Point& p) {
    Direction v;
    for (int k = 0; k < Dim; ++k) v[k] = p[k];
    return v;
  };
  int pulls = static_cast<int>(interfaces.sites.size());
  site_of_.assign(ids.size(), -1);
  for (std::size_t s = 0; s < interfaces.sites.size(); ++s) {
    const Interfaces::Site& from = interfaces.sites[s];
    StoredSite site{};
    site.i = where[from.id], site.own = initial.material[from.id], site.other = from.other;
    site.V = bonds.volume[from.id], site.share = from.share;
    site.N = vector(from.N), site.m = vector(from.m);
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) site.B(k, a) = bonds.B[from.id][a][k];
    site.bond = static_cast<int>(bonds_.size()), site.kink = static_cast<int>(kinks_.size());
    for (const SiteBond& b : site_bonds(bonds, initial, setup.materials, from.id))
      bonds_.push_back({where[b.j], vector(b.g), vector(b.e), b.per_r0_squared, b.strength, b.own_strength,
                        b.is_across ? pulls++ : -1});
    for (int b = interfaces.begin[s]; b < interfaces.begin[s + 1]; ++b)
      kinks_.push_back({where[interfaces.j[b]], interfaces.weight[b]});
    site.bonds = static_cast<int>(bonds_.size()), site.kinks = static_cast<int>(kinks_.size());
    site_of_[site.i] = static_cast<int>(s);
    sites_.push_back(site);
  }
  pulls_.resize(pulls);
  share_out();
}

/// Sorts shares by group: no two threads add to one group.
template <int Dim>
void InterfaceSites<Dim>::share_out() {
  struct Part {
    int i;
    PullShare share;
  };
  std::vector<Part> parts;
  for (int s = 0; s < static_cast<int>(sites_.size()); ++s) {
    double of_all = 0;
    for (int k = sites_[s].kink; k < sites_[s].kinks; ++k) {
      parts.push_back({kinks_[k].j, {s, kinks_[k].j % lanes, -kinks_[k].weight}});
      of_all += kinks_[k].weight;
    }
    const int i = sites_[s].i;
    parts.push_back({i, {s, i % lanes, of_all}});
    for (int k = sites_[s].bond; k < sites_[s].bonds; ++k) {
      if (bonds_[k].pull < 0) continue;
      parts.push_back({i, {bonds_[k].pull, i % lanes, 1}});
      parts.push_back({bonds_[k].j, {bonds_[k].pull, bonds_[k].j % lanes, -1}});
    }
  }
  std::ranges::stable_sort(parts, {}, &Part::i);
  for (const Part& part : parts) {
    const int group = part.i / lanes, at = static_cast<int>(shares_.size());
    if (affected_.empty() || affected_.back().group != group) affected_.push_back({group, at, at});
    shares_.push_back(part.share);
    affected_.back().end = at + 1;
  }
}

template <int Dim>
template <class Column>
auto InterfaceSites<Dim>::deformations(const StoredSite& site, const Column& x) const -> Deformations {
  Deformations of{};
  for (int k = site.bond; k < site.bonds; ++k) {
    const Direction d = x[bonds_[k].j] - x[site.i];
    of.mean = with(of.mean, 1, d, bonds_[k].g);
  }
  Direction b{};
  for (int k = site.kink; k < site.kinks; ++k) b += kinks_[k].weight * (x[kinks_[k].j] - x[site.i]);
  of.own = with(of.mean, 1, b, site.m);
  of.other = with(of.own, -1, b, site.N);
  of.across = with(of.own, -0.5, b, site.N);
  return of;
}

/// Excludes φ(s), the energy of the spring.
template <int Dim>
auto InterfaceSites<Dim>::energy_across(const StoredSiteBond& bond, double s, double across, double own)
    -> AcrossEnergy {
  const double difference =
      bond.own_strength * cancelled_slope<Dim>(own) - bond.strength * cancelled_slope<Dim>(across);
  const double deviation = s - across,
               missing_strength = 0.25 * std::max(0.0, bond.own_strength - bond.strength);
  return {(0.5 * difference + 0.5 * missing_strength * deviation) * deviation -
              bond.strength * cancelled_energy<Dim>(across),
          0.5 * difference + missing_strength * deviation,
          -0.5 * (bond.own_strength * cancelled_slope<Dim>(own) +
                  bond.strength * cancelled_slope_rate<Dim>(across) * deviation) -
              missing_strength * deviation,
          0.5 * bond.own_strength * cancelled_slope_rate<Dim>(own) * deviation};
}

template <int Dim>
template <class Column, class Law>
Mat<double, Dim> InterfaceSites<Dim>::stress(int n, const Column& x, const Law& law) {
  const StoredSite& site = sites_[n];
  const Deformations at = deformations(site, x);
  Square own = (site.V * (1 - site.share)) * law.piola(site.own, at.own), across{};
  const Square other = (site.V * site.share) * law.piola(site.other, at.other);
  for (int k = site.bond; k < site.bonds; ++k) {
    const StoredSiteBond& bond = bonds_[k];
    const Direction pulled = at.own * bond.e;
    const double s_own = dot(pulled, pulled);
    if (bond.pull < 0) {
      own = with(own, -bond.strength * cancelled_slope<Dim>(s_own), pulled, bond.e);
      continue;
    }
    const Direction middle = at.across * bond.e, d = x[bond.j] - x[site.i];
    const AcrossEnergy stored =
        energy_across(bond, bond.per_r0_squared * dot(d, d), dot(middle, middle), s_own);
    own = with(own, 2 * stored.of_own, pulled, bond.e);
    across = with(across, 2 * stored.of_across, middle, bond.e);
    pulls_[bond.pull] = (2 * bond.per_r0_squared * stored.of_s) * d;
  }
  const Square all = own + other + across;
  pulls_[n] = all * site.m - other * site.N - 0.5 * (across * site.N);
  return all;
}

template <int Dim>
template <class Column, class Law>
double InterfaceSites<Dim>::energy_of_kink(int i, const Column& x, const Law& law) const {
  if (sites_.empty() || site_of_[i] < 0) return 0;
  const StoredSite& site = sites_[site_of_[i]];
  const Deformations at = deformations(site, x);
  double E = site.V * ((1 - site.share) * law.energy(site.own, at.own) +
                       site.share * law.energy(site.other, at.other) - law.energy(site.own, at.mean));
  for (int k = site.bond; k < site.bonds; ++k) {
    const StoredSiteBond& bond = bonds_[k];
    const Direction own = at.own * bond.e, middle = at.across * bond.e, plain = at.mean * bond.e,
                    d = x[bond.j] - x[site.i];
    E += bond.strength * cancelled_energy<Dim>(dot(plain, plain));
    E +=
        bond.pull < 0
            ? -bond.strength * cancelled_energy<Dim>(dot(own, own))
            : energy_across(bond, bond.per_r0_squared * dot(d, d), dot(middle, middle), dot(own, own)).energy;
  }
  return E;
}

template <int Dim>
template <class Column, class Law>
void InterfaceSites<Dim>::pass(const Column& x, const Law& law, int threads, Columns<Dim * Dim>& Q,
                               std::vector<Vec<Pack, Dim>>& bond_force) {
  if (sites_.empty()) return;
  parallel_for(static_cast<int>(sites_.size()), threads, [&](int n) {
    const Square own = product(stress(n, x, law), sites_[n].B);
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) Q[a * Dim + k][sites_[n].i] = own(a, k);
  });
  parallel_for(static_cast<int>(affected_.size()), threads, [&](int k) {
    for (int n = affected_[k].begin; n < affected_[k].end; ++n)
      for (int a = 0; a < Dim; ++a)
        bond_force[affected_[k].group][a][shares_[n].lane] += shares_[n].weight * pulls_[shares_[n].pull][a];
  });
}
inline constexpr TermInfo interface_info{
    "interface", "E_i = V_i [(1 − θ) W_own(F_own) + θ W_other(F_other)] − …, F_own − F_other = b ⊗ N", "ours",
    "methods/bonded/interface_sites.hpp:stress",
    "oenog: layers of two materials leave no force where they meet"};

}  // namespace taut
