#include "engine/methods/bonded/layout/solid_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <Eigen/Core>

#include "engine/core/growth.hpp"
#include "engine/core/parallel.hpp"
#include "engine/methods/bonded/layout/bond_gradients.hpp"
#include "engine/methods/bonded/layout/bond_moments.hpp"
#include "engine/methods/bonded/layout/off_lattice.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {
namespace {

/// Number of neighbours inside a lattice.
constexpr std::size_t whole = 26;

/// w for `r` in spacings (THEORY.md, Three dimensions).
double lattice_weight(double r) {
  constexpr double t = 3.0 / 8;
  static const double axis = rounded_weight(0.5 + 4 * t / 9), face = rounded_weight(1 - 8 * t / 9);
  return r < 1.2 ? axis : r < 1.58 ? face : t;
}

class SolidBonds {
 public:
  SolidBonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
             int threads)
      : initial_(initial),
        spacing_(spacing),
        near_(initial_neighbors(initial, least_bond_reach * h, threads)),
        irregular_bodies_(irregular_bodies(initial, constraints, near_, spacing, threads)),
        geometry_{initial.x, spacing, {}, {}, {}, false} {
    extend_reach(h, threads);
    weigh_irregular(threads);
    choose_gradients(threads);
  }

  Bonds finish() && {
    Bonds out;
    out.begin.assign(near_.begin.begin(), near_.begin.end());
    out.j = std::move(near_.j);
    out.row.assign(initial_.size(), -1);
    out.off_lattice = geometry_.off_lattice;
    out.solid = std::make_shared<const SolidGeometry>(std::move(geometry_));
    return out;
  }

 private:
  struct Selection {
    std::vector<Eigen::Vector3d> X;
    std::vector<std::size_t> of;
    std::vector<double> w;
  };

  bool is_irregular(int i) const { return irregular_bodies_[initial_.body[i]]; }
  Selection selection(int i) const {
    Selection out;
    for (std::size_t k = 0; k < near_[i].size(); ++k) {
      const Eigen::Vector3d X = vector_of<3>(initial_.x[near_[i][k]]) - vector_of<3>(initial_.x[i]);
      if (geometry_.off_lattice && !(X.norm() < reach_[i])) continue;
      out.X.push_back(X), out.of.push_back(k), out.w.push_back(lattice_weight(X.norm() / spacing_));
    }
    return out;
  }
  void extend_reach(double h, int threads) {
    const int n = initial_.size();
    std::vector<unsigned char> further(n);
    parallel_for(n, threads, [&](int i) {
      if (near_[i].size() == whole) return;
      const Selection own = selection(i);
      further[i] = !is_on_lattice(own.X, spacing_) && !is_at_surface(own.X);
    });
    if (std::ranges::count(further, 0) == n) return;
    near_ = linked_neighbors(initial_, greatest_bond_reach * h, spacing_, threads);
    const Moments<3> moments;
    std::vector<double> reach(n, least_bond_reach * h);
    parallel_for(n, threads, [&](int i) {
      if (further[i] == 0) return;
      const Selection all = selection(i);
      for (double far = least_bond_reach; far <= greatest_bond_reach; far += 0.125) {
        Selection within;
        for (std::size_t k = 0; k < all.X.size(); ++k)
          if (all.X[k].norm() < far * h) within.X.push_back(all.X[k]), within.w.push_back(all.w[k]);
        if (!moments.make_right(within.X, within.w)) continue;
        reach[i] = far * h;
        return;
      }
    });
    reach_.swap(reach);
    geometry_.off_lattice = true;
    NeighborLists chosen;
    chosen.begin.push_back(0);
    for (int i = 0; i < n; ++i) {
      for (const int j : near_[i])
        if ((vector_of<3>(initial_.x[j]) - vector_of<3>(initial_.x[i])).norm() <
            std::max(reach_[i], reach_[j]))
          chosen.j.push_back(j);
      chosen.begin.push_back(chosen.j.size());
    }
    near_ = std::move(chosen);
  }
  /// Weights of the bonds of i; empty for lattice weights (THEORY.md, Three dimensions).
  std::vector<double> own_weights(int i) const {
    static const Moments<3> moments;
    Selection own = selection(i);
    if (own.X.size() == near_[i].size() && is_on_lattice(own.X, spacing_)) return {};
    const std::vector<double> of_lattice = own.w;
    const bool inside = own.X.size() == whole || (geometry_.off_lattice && !is_at_surface(own.X));
    const bool right = inside && moments.make_right(own.X, own.w);
    if (geometry_.off_lattice && !right) {
      own.w = of_lattice;
      const double too_stiff = excess(own.X, own.w);
      for (double& w : own.w) w /= std::max(1.0, too_stiff);
    }
    std::vector<double> weights(near_[i].size());  // 0 if only the other end selected it
    for (std::size_t b = 0; b < own.of.size(); ++b) weights[own.of[b]] = rounded_weight(own.w[b]);
    return weights == of_lattice ? std::vector<double>() : weights;
  }
  void weigh_irregular(int threads) {
    std::vector<int>& irregular = geometry_.irregular;
    std::vector<double>& weights = geometry_.weights;
    irregular.assign(initial_.size(), -1);
    const auto make = [&](int i) { return own_weights(i); };
    make_in_order(initial_.size(), threads, make, [&](int i, const std::vector<double>& w) {
      if (!w.empty()) irregular[i] = static_cast<int>(weights.size());
      make_room(weights, w.size(), static_cast<std::size_t>(i), irregular.size());
      weights.insert(weights.end(), w.begin(), w.end());
    });
  }
  void choose_gradients(int threads) {
    // minimum of det A/(tr A/3)³ with A = Σ_j a_ij ⊗ X_ij; isotropic: 1
    constexpr double least = 0.5, least_of_irregular = 0.7;
    using enum SolidGeometry::Gradient;
    geometry_.gradient.assign(initial_.size(), of_axes);
    std::vector<SolidGeometry::Gradient> needed(initial_.size());
    parallel_for(initial_.size(), threads, [&](int i) {
      Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
      for (std::size_t k = 0; k < near_[i].size(); ++k) {
        const ReferenceBond bond = geometry_.bond(i, near_[i][k], k);
        A += vector_of<3>(bond.area) * vector_of<3>(bond.X).transpose();
      }
      const bool is_determined =
          A.determinant() > (is_irregular(i) ? least_of_irregular : least) * std::pow(A.trace() / 3, 3);
      needed[i] = is_determined ? of_axes : is_irregular(i) ? even : steep;
    });
    geometry_.gradient.swap(needed);
  }

  const InitialParticles& initial_;
  double spacing_;
  NeighborLists near_;
  std::vector<bool> irregular_bodies_;
  std::vector<double> reach_;  // [n] m; empty: all neighbours
  SolidGeometry geometry_;
};

}  // namespace

/// Rounds X so that equal bonds of a lattice have equal bits.
ReferenceBond SolidGeometry::bond(int i, int j, std::size_t k) const {
  const Point &from = x[i], &to = x[j];
  ReferenceBond one{};
  double r2 = 0;
  for (std::size_t a = 0; a < one.X.size(); ++a) {
    one.X[a] = std::round((to[a] - from[a]) / spacing * 0x1p40) * 0x1p-40 * spacing + 0.0;
    r2 += one.X[a] * one.X[a];
  }
  const double per_r = spacing / std::sqrt(r2);
  one.weight = irregular[i] < 0 ? lattice_weight(1 / per_r) : weights[irregular[i] + k];
  const Gradient rule = std::max(gradient[i], gradient[j]);
  const double share = rule == Gradient::even    ? even_share(per_r)
                       : rule == Gradient::steep ? steep_share(per_r)
                       : per_r > 0.83            ? 1
                                                 : 0;
  for (std::size_t a = 0; a < one.X.size(); ++a)
    one.area[a] = off_lattice ? single_precision(share * one.X[a] / spacing) : share * one.X[a];
  return one;
}

Bonds solid_bonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
                  int threads) {
  return SolidBonds(initial, constraints, spacing, h, threads).finish();
}

}  // namespace taut
