#include "engine/families/bonded/solid_bonds.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/growth.hpp"
#include "engine/core/parallel.hpp"
#include "engine/families/bonded/bond_gradients.hpp"
#include "engine/families/bonded/bond_moments.hpp"
#include "engine/families/bonded/off_lattice.hpp"

namespace taut {
namespace {

constexpr std::size_t whole = 26;

/// w of a bond of the cubic lattice, `r` in spacings: along an axis, across a face, across the cube. With
/// (½ + 4t/9, 1 − 8t/9, t) of any t the fourth moments are isotropic; t = 3/8 has the least error (of t = 0,
/// whose bonds are 18, it is about twice as large).
/// Off a lattice it is what they are chosen nearest to.
double lattice_weight(double r) {
  constexpr double t = 3.0 / 8;
  static const double axis = rounded_weight(0.5 + 4 * t / 9), face = rounded_weight(1 - 8 * t / 9);
  return r < 1.2 ? axis : r < 1.58 ? face : t;
}

}  // namespace

SolidBonds::SolidBonds(const InitialParticles& initial, double spacing, double h, int threads)
    : initial_(initial),
      spacing_(spacing),
      near_(initial_neighbors(initial, least_bond_reach * h, threads)),
      lies_irregular_(irregular_bodies(initial, near_, spacing, threads)),
      geometry_{initial.x, spacing, {}, {}, {}, false} {
  look_further(h, threads);
  weigh_irregular(threads);
  help_who_lack_an_axis(threads);
}

/// X to 2^-40 of a spacing, so that the bonds of a lattice are the same wherever they are.
Bond SolidGeometry::bond(int i, int j, std::size_t k) const {
  const Point &from = x[i], &to = x[j];
  Bond one{};
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

SolidBonds::Asked SolidBonds::asked(int i) const {
  Asked out;
  for (std::size_t k = 0; k < near_[i].size(); ++k) {
    const Eigen::Vector3d X = vector_of<3>(initial_.x[near_[i][k]]) - vector_of<3>(initial_.x[i]);
    if (geometry_.off_lattice && !(X.norm() < reach_[i])) continue;
    out.X.push_back(X), out.of.push_back(k), out.w.push_back(lattice_weight(X.norm() / spacing_));
  }
  return out;
}

/// A particle inside that has more or fewer than 26 within 2h takes its bonds from as far as there are right
/// weights for them.
void SolidBonds::look_further(double h, int threads) {
  const int n = initial_.size();
  std::vector<unsigned char> further(n);
  parallel_for(n, threads, [&](int i) {
    if (near_[i].size() == whole) return;
    const Asked own = asked(i);
    further[i] = !on_lattice(own.X, spacing_) && !at_surface(own.X);
  });
  if (std::ranges::count(further, 0) == n) return;
  near_ = linked_neighbors(initial_, greatest_bond_reach * h, spacing_, threads);
  const Moments<3> moments;
  std::vector<double> reach(n, least_bond_reach * h);
  parallel_for(n, threads, [&](int i) {
    if (further[i] == 0) return;
    const Asked all = asked(i);
    for (double far = least_bond_reach; far <= greatest_bond_reach; far += 0.125) {
      Asked within;
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
      if ((vector_of<3>(initial_.x[j]) - vector_of<3>(initial_.x[i])).norm() < std::max(reach_[i], reach_[j]))
        chosen.j.push_back(j);
    chosen.begin.push_back(chosen.j.size());
  }
  near_ = std::move(chosen);
}

/// w of each that is near; none where they are those of a lattice. A particle inside asks for right moments,
/// which it finds as they are on a lattice. Of another one a missing neighbour is a missing bond, and nothing is
/// reweighted, but off a lattice where its bonds would be stiffer than the solid in some strain: what is
/// cancelled of them would then be more than W gives, and the body have no least energy.
std::vector<double> SolidBonds::own_weights(int i) const {
  static const Moments<3> moments;
  Asked own = asked(i);
  if (own.X.size() == near_[i].size() && on_lattice(own.X, spacing_)) return {};
  const std::vector<double> of_lattice = own.w;
  const bool inside = own.X.size() == whole || (geometry_.off_lattice && !at_surface(own.X));
  const bool right = inside && moments.make_right(own.X, own.w);
  if (geometry_.off_lattice && !right) {
    own.w = of_lattice;
    const double too_stiff = excess(own.X, own.w);
    for (double& w : own.w) w /= std::max(1.0, too_stiff);
  }
  std::vector<double> weights(near_[i].size());  // 0 of bonds that only the other end has asked for
  for (std::size_t b = 0; b < own.of.size(); ++b) weights[own.of[b]] = rounded_weight(own.w[b]);
  return weights == of_lattice ? std::vector<double>() : weights;
}

void SolidBonds::weigh_irregular(int threads) {
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

/// A particle whose nearest say little of the gradient along one of the axes, or nothing, as those of the tips
/// of round bodies, takes it from all its bonds, and so do their other ends of them.
void SolidBonds::help_who_lack_an_axis(int threads) {
  // of det A over that of as great an A that is the same for all directions
  constexpr double least = 0.5, least_of_irregular = 0.7;
  using enum SolidGeometry::Gradient;
  geometry_.gradient.assign(initial_.size(), of_axes);
  std::vector<SolidGeometry::Gradient> needed(initial_.size());
  parallel_for(initial_.size(), threads, [&](int i) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    for_each(i,
             [&](int, const Bond& bond) { A += vector_of<3>(bond.area) * vector_of<3>(bond.X).transpose(); });
    const bool has_all =
        A.determinant() > (lies_irregular(i) ? least_of_irregular : least) * std::pow(A.trace() / 3, 3);
    needed[i] = has_all ? of_axes : lies_irregular(i) ? even : steep;
  });
  geometry_.gradient.swap(needed);
}

}  // namespace taut
