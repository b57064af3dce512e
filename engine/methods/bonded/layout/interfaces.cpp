#include "engine/methods/bonded/layout/interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <Eigen/LU>

#include "engine/core/principal_axes.hpp"

namespace taut {
namespace {

using Place = Eigen::Vector3d;
using Square = Eigen::Matrix3d;

Place column(const Point& p) { return Eigen::Map<const Place>(p.data()); }
Point point(const Place& v) { return {v[0], v[1], v[2]}; }

struct SideGradient {
  int j;
  Place g;
};

bool is_across(const Bonds& bonds, const InitialParticles& initial, const std::vector<Elasticity>& materials,
               int i, int j) {
  if (bonds.is_rigid(i) || bonds.is_rigid(j)) return false;
  const Elasticity &own = materials[initial.material[i]], &other = materials[initial.material[j]];
  return own.K != other.K || own.G != other.G || own.of_law != other.of_law;
}

class InterfaceMaker {
 public:
  InterfaceMaker(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                 const Bonds& bonds, double spacing)
      : initial_(initial), materials_(materials), bonds_(bonds), spacing_(spacing) {}

  Interfaces make() {
    out_.begin.push_back(0);
    const std::vector<int>& material = initial_.material;
    if (std::ranges::count(material, material.front()) == std::ssize(material)) return std::move(out_);
    for (int i = 0; i < initial_.size(); ++i)
      if (const auto other = other_material(i)) add_site(i, *other);
    out_.wave_speed = wave_speed();
    return std::move(out_);
  }

 private:
  bool is_across(int i, int j) const { return taut::is_across(bonds_, initial_, materials_, i, j); }
  /// The only other material bonded to i; nothing at or beside rigid particles.
  std::optional<int> other_material(int i) const {
    std::optional<int> other;
    if (bonds_.is_rigid(i) || !(bonds_.B[i][0][0] > 0)) return {};
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
      const int j = bonds_.j[b];
      if (bonds_.is_rigid(j)) return {};
      if (!is_across(i, j)) continue;
      if (other && *other != initial_.material[j]) return {};
      other = initial_.material[j];
    }
    return other;
  }
  /// Unit normal at i of the plane through the midpoints of nearby bonds across the interface; nothing if they are
  /// not nearly in a plane.
  std::optional<Place> normal(int i, int other) const {
    // maximum ratio of variances across and along the plane
    constexpr double flat = 0.08;
    std::vector<Place> middles;
    Place mean = Place::Zero(), towards = Place::Zero();
    const auto add_middles = [&](int k) {
      const bool own = initial_.material[k] == initial_.material[i];
      if (!own && initial_.material[k] != other) return;
      for (int b = bonds_.begin[k]; b < bonds_.begin[k + 1]; ++b) {
        const int l = bonds_.j[b];
        if (!is_across(k, l) || initial_.material[l] != (own ? other : initial_.material[i])) continue;
        middles.push_back(column(initial_.x[k]) - column(initial_.x[i]) + 0.5 * column(bonds_.of(k, b).X));
        mean += middles.back();
        towards += (own ? 1 : -1) * column(bonds_.of(k, b).X);
      }
    };
    add_middles(i);
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) add_middles(bonds_.j[b]);
    mean /= static_cast<double>(middles.size());
    Sym<double, 3> spread{};
    for (const Place& one : middles)
      for (int a = 0; a < 3; ++a)
        for (int c = a; c < 3; ++c) spread(a, c) += (one - mean)[a] * (one - mean)[c];
    if (initial_.dim == 2) spread(2, 2) = 2 * (spread(0, 0) + spread(1, 1));  // cannot be the normal
    const Principal axes = principal_axes(spread);
    std::array<int, 3> order{0, 1, 2};
    std::ranges::sort(order, {}, [&](int k) { return axes.value[k]; });
    if (!(axes.value[order[0]] < flat * axes.value[order[1]])) return {};
    const auto& axis = axes.axis[order[0]];
    const Place N{axis[0], axis[1], initial_.dim == 2 ? 0 : axis[2]};
    return N.dot(towards) < 0 ? -N : N;
  }
  /// Gradient within the material; empty where bonds hardly determine it: the energy would have no minimum.
  std::vector<SideGradient> own_gradient(int i) const {
    constexpr double least = 0.5;  // of det A/(tr A/dim)^dim; 1 if isotropic
    Square A = Square::Zero();
    std::vector<SideGradient> entries;
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
      const int j = bonds_.j[b];
      if (is_across(i, j) || bonds_.is_rigid(j) || bonds_.of(i, b).area == Point{}) continue;
      A += column(bonds_.of(i, b).area) * column(bonds_.of(i, b).X).transpose();
      entries.push_back({j, column(bonds_.of(i, b).area)});
    }
    const double scale = A.trace() / initial_.dim;
    if (initial_.dim == 2) A(2, 2) = scale;
    if (!(A.determinant() > least * std::pow(scale, 3))) return {};
    const Square B = A.inverse();
    for (SideGradient& entry : entries) entry.g = B * entry.g;
    return entries;
  }
  void add_site(int i, int other) {
    const auto N = normal(i, other);
    const std::vector<SideGradient> own = own_gradient(i);
    if (!N || own.empty()) return;
    Place m = Place::Zero();
    std::map<int, double> beta;
    double weights = 0;
    std::vector<std::pair<double, std::vector<SideGradient>>> beyond;
    std::vector<int> of;
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
      const int k = bonds_.j[b];
      if (!is_across(i, k)) continue;
      m += 0.5 * N->dot(column(bonds_.of(i, b).X)) * column(bonds_.gradient(i, b));
      const double weight = column(bonds_.of(i, b).area).norm();
      if (!(weight > 0)) continue;
      std::vector<SideGradient> one = own_gradient(k);
      if (one.empty()) continue;
      beyond.emplace_back(weight, std::move(one));
      of.push_back(k);
      weights += weight;
    }
    const double share = N->dot(m);
    if (beyond.empty() || !(share > 0 && share < 0.75)) return;
    for (const SideGradient& e : own) beta[e.j] += N->dot(e.g);
    for (std::size_t k = 0; k < beyond.size(); ++k) {
      for (const SideGradient& e : beyond[k].second) {
        const double of_one = beyond[k].first / weights * N->dot(e.g);
        beta[e.j] -= of_one;
        beta[of[k]] += of_one;
      }
    }
    beta.erase(i);
    out_.sites.push_back({i, other, share, point(*N), point(m)});
    for (const auto& [j, weight] : beta) out_.j.push_back(j), out_.weight.push_back(weight);
    out_.begin.push_back(static_cast<int>(out_.j.size()));
  }
  /// In m/s, from row sums of stiffness over mass.
  double wave_speed() const {
    std::vector<double> stiffness(bonds_.begin.size() - 1);
    for (std::size_t s = 0; s < out_.sites.size(); ++s) {
      const Interfaces::Site& site = out_.sites[s];
      const Place m = column(site.m), beyond = m - column(site.N);
      std::map<int, std::pair<Place, Place>> slopes;
      const auto add = [&](int j, const Place& own, const Place& other) {
        for (const auto& [p, sign] : {std::pair{j, 1.0}, std::pair{site.id, -1.0}}) {
          auto& of = slopes.try_emplace(p, Place::Zero(), Place::Zero()).first->second;
          of.first += sign * own, of.second += sign * other;
        }
      };
      for (int b = bonds_.begin[site.id]; b < bonds_.begin[site.id + 1]; ++b) {
        const Place g = column(bonds_.gradient(site.id, b));
        add(bonds_.j[b], g, g);
      }
      for (int b = out_.begin[s]; b < out_.begin[s + 1]; ++b)
        add(out_.j[b], out_.weight[b] * m, out_.weight[b] * beyond);
      double own = 0, other = 0;
      for (const auto& [p, of] : slopes) own += of.first.norm(), other += of.second.norm();
      const double V = bonds_.volume[site.id];
      for (const auto& [p, of] : slopes)
        stiffness[p] +=
            V * ((1 - site.share) * wave_modulus(initial_.material[site.id]) * of.first.norm() * own +
                 site.share * wave_modulus(site.other) * of.second.norm() * other);
    }
    double greatest = 0;
    for (int p = 0; p < initial_.size(); ++p)
      greatest = std::max(greatest, stiffness[p] / (materials_[initial_.material[p]].rho0 * bonds_.mass[p]));
    return spacing_ * std::sqrt(greatest) / initial_.dim;
  }
  double wave_modulus(int material) const {
    return materials_[material].K + 4.0 / 3 * materials_[material].G;
  }

  const InitialParticles& initial_;
  const std::vector<Elasticity>& materials_;
  const Bonds& bonds_;
  double spacing_;
  Interfaces out_;
};

}  // namespace

Interfaces make_interfaces(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                           const Bonds& bonds, double spacing) {
  return InterfaceMaker(initial, materials, bonds, spacing).make();
}

std::vector<SiteBond> site_bonds(const Bonds& bonds, const InitialParticles& initial,
                                 const std::vector<Elasticity>& materials, int i) {
  std::vector<SiteBond> out;
  for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b) {
    const ReferenceBond own = bonds.of(i, b);
    double r2 = 0;
    for (int k = 0; k < initial.dim; ++k) r2 += own.X[k] * own.X[k];
    Point e{};
    for (int k = 0; k < initial.dim; ++k) e[k] = 1 / std::sqrt(r2) * own.X[k];
    const double G = modulus_of_bond(bonds, initial, materials, i, b), V0_w = initial.V0[i] * own.weight,
                 own_G = modulus_of_bonds(initial.dim, materials[initial.material[i]]);
    out.push_back({bonds.j[b], bonds.gradient(i, b), e, 1 / r2, G * V0_w,
                   std::min(own_G, greatest_across * G) * V0_w,
                   is_across(bonds, initial, materials, i, bonds.j[b])});
  }
  return out;
}

}  // namespace taut
