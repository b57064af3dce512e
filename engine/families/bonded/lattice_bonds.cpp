#include "engine/families/bonded/lattice_bonds.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.hpp"
#include "engine/families/bonded/bond_gradients.hpp"
#include "engine/families/bonded/bond_moments.hpp"

namespace taut {
namespace {

constexpr std::size_t whole = 26;

/// w of a bond of the cubic lattice, `r` in spacings: along an axis, across a face, across the cube. With
/// (½ + 4t/9, 1 − 8t/9, t) of any t the fourth moments are isotropic; t = 3/8 has the least error (of t = 0,
/// whose bonds are 18, it is about twice as large).
double lattice_weight(double r) {
  constexpr double t = 3.0 / 8;
  static const double axis = rounded_weight(0.5 + 4 * t / 9), face = rounded_weight(1 - 8 * t / 9);
  return r < 1.2 ? axis : r < 1.58 ? face : t;
}

}  // namespace

LatticeBonds::LatticeBonds(const InitialParticles& initial, double spacing, double h, int threads)
    : initial_(initial), spacing_(spacing), near_(initial_neighbors(initial, least_bond_reach * h, threads)) {
  weigh_irregular(threads);
  help_who_lack_an_axis(threads);
}

/// X to 2^-40 of a spacing, so that the bonds of a lattice are the same wherever they are.
Bond LatticeBonds::bond(int i, int j, std::size_t k) const {
  const Point &from = initial_.x[i], &to = initial_.x[j];
  Bond one{};
  double r2 = 0;
  for (std::size_t a = 0; a < one.X.size(); ++a) {
    one.X[a] = std::round((to[a] - from[a]) / spacing_ * 0x1p40) * 0x1p-40 * spacing_ + 0.0;
    r2 += one.X[a] * one.X[a];
  }
  const double per_r = spacing_ / std::sqrt(r2);
  one.weight = irregular_[i] < 0 ? lattice_weight(1 / per_r) : weights_[irregular_[i] + k];
  const double share = !helped_.empty() && (helped_[i] != 0 || helped_[j] != 0) ? std::pow(per_r, 8)
                       : per_r > 0.83                                           ? 1
                                                                                : 0;
  for (std::size_t a = 0; a < one.X.size(); ++a) one.area[a] = share * one.X[a];
  return one;
}

/// A particle that has them all asks for right moments, which it finds as they are on a lattice; of another
/// one a missing neighbour is a missing bond and nothing is reweighted.
void LatticeBonds::weigh_irregular(int threads) {
  const Moments<3> moments;
  irregular_.assign(initial_.size(), -1);
  const auto changed = [&](int i) {
    std::vector<Eigen::Vector3d> X;
    std::vector<double> w;
    if (near_[i].size() != whole) return w;
    for (const int j : near_[i]) {
      X.push_back(vector_of<3>(initial_.x[j]) - vector_of<3>(initial_.x[i]));
      w.push_back(lattice_weight(X.back().norm() / spacing_));
    }
    const std::vector<double> of_lattice = w;
    moments.make_right(X, w);
    std::ranges::transform(w, w.begin(), rounded_weight);
    return w == of_lattice ? std::vector<double>() : w;
  };
  make_in_order(initial_.size(), threads, changed, [&](int i, const std::vector<double>& w) {
    if (!w.empty()) irregular_[i] = static_cast<int>(weights_.size());
    weights_.insert(weights_.end(), w.begin(), w.end());
  });
}

/// A particle that has no neighbour on one of the axes, as the tips of round bodies, takes the gradient from
/// all its bonds, and so do their other ends of them.
void LatticeBonds::help_who_lack_an_axis(int threads) {
  const auto B = inverse_moments<3>(*this, initial_.size(), threads);
  std::vector<unsigned char> lack(B.size());
  std::ranges::transform(B, lack.begin(), [](const auto& one) { return !(one[0][0] > 0); });
  helped_.swap(lack);
}

}  // namespace taut
