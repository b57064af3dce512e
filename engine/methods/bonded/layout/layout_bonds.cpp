#include "engine/methods/bonded/layout/layout_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "engine/core/parallel.hpp"
#include "engine/methods/bonded/layout/balance.hpp"
#include "engine/methods/bonded/layout/bond_gradients.hpp"
#include "engine/methods/bonded/layout/bond_moments.hpp"
#include "engine/methods/bonded/layout/off_lattice.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {
namespace {

class LayoutBonds {
 public:
  LayoutBonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
              int threads)
      : initial_(initial),
        constraints_(constraints),
        spacing_(spacing),
        h_(h),
        threads_(threads),
        near_(linked_neighbors(initial, greatest_bond_reach * h, spacing, threads)),
        irregular_(irregular_bodies(initial, constraints, near_, spacing, threads)) {
    for (const bool irregular : irregular_)
      least_reach_.push_back(irregular ? wide_bond_reach : least_bond_reach);
  }

  Bonds make() {
    make_balanced();
    const std::vector<int> weak = bodies_with_pair_below(least_strength);
    for (const int body : weak) least_reach_[body] = wide_bond_reach;
    if (!weak.empty()) make_balanced();
    for (const int body : bodies_with_pair_below(-least_strength))
      for (int b = out_.begin[initial_.first[body]]; b < out_.begin[initial_.first[body + 1]]; ++b)
        out_.rows[b].weight = unbalanced_[b];
    out_.off_lattice = changed_by_balance_ || std::ranges::count(irregular_, true) > 0;
    return std::move(out_);
  }

 private:
  /// Strength (V0_i w_ij + V0_j w_ji)/V0_i below which a pair is weak.
  static constexpr double least_strength = 0.4;
  static constexpr double not_selected = -1;
  static constexpr double greatest_at_surface = 1;  // w in irregular bodies

  void make_balanced() {
    select();
    set_ends();
    out_.B = inverse_moments<2>(out_, initial_.size(), threads_);
    unbalanced_.resize(out_.rows.size());
    std::ranges::transform(out_.rows, unbalanced_.begin(), &ReferenceBond::weight);
    balance(initial_, constraints_, irregular_, out_, threads_);
    changed_by_balance_ = !std::ranges::equal(out_.rows, unbalanced_, {}, &ReferenceBond::weight);
  }
  struct Selection {
    std::vector<Eigen::Vector2d> X;
    std::vector<double> w;
    std::vector<std::size_t> pairs;
  };
  void select() {
    const Moments<2> moments;
    selected_.assign(near_.j.size(), not_selected);
    parallel_chunks(initial_.size(), threads_, [&](int, int first, int last) {
      Selection own;
      for (int i = first; i < last; ++i) select(i, moments, own);
    });
  }
  void select(int i, const Moments<2>& moments, Selection& own) {
    std::vector<Eigen::Vector2d>& X = own.X;
    std::vector<double>& w = own.w;
    const double least = least_reach_[initial_.body[i]];
    const auto store = [&] {
      std::fill_n(selected_.begin() + near_.begin[i], near_[i].size(), not_selected);
      for (std::size_t b = 0; b < w.size(); ++b) selected_[own.pairs[b]] = rounded_weight(w[b]);
    };
    for (double reach = least; reach <= greatest_bond_reach; reach += 0.125) {
      select_within(reach, i, own);
      if (irregular_[initial_.body[i]] && is_at_surface(X)) {
        w.assign(X.size(), greatest_at_surface);
        const double too_stiff = std::max(1.0, excess(X, w));
        for (double& one : w) one /= too_stiff;
        return store();
      }
      const bool right = moments.make_right(X, w);
      if (!right && reach > least) continue;  // keeps the first choice if none is right
      store();
      if (right) return;
    }
  }
  void select_within(double reach, int i, Selection& own) const {
    const std::span<const int> near = near_[i];
    own.X.clear(), own.w.clear(), own.pairs.clear();
    for (std::size_t k = 0; k < near.size(); ++k) {
      const Eigen::Vector2d one = vector_of<2>(initial_.x[near[k]]) - vector_of<2>(initial_.x[i]);
      if (!(one.norm() < reach * h_ * (1 - 1e-9))) continue;
      own.X.push_back(one);
      own.w.push_back(initial_.V0[near[k]] / one.squaredNorm());
      own.pairs.push_back(near_.begin[i] + k);
    }
  }
  void set_ends() {
    const auto is_selected = [&](std::size_t pair, std::size_t back) {
      return selected_[pair] != not_selected || selected_[back] != not_selected;
    };
    const int n = initial_.size();
    std::vector<std::size_t> back(near_.j.size());
    out_ = {};
    out_.begin.assign(n + 1, 0);
    parallel_for(n, threads_, [&](int i) {
      for (std::size_t pair = near_.begin[i]; pair < near_.begin[i + 1]; ++pair) {
        back[pair] = near_.find(near_.j[pair], i);
        out_.begin[i + 1] += is_selected(pair, back[pair]);
      }
    });
    std::partial_sum(out_.begin.begin(), out_.begin.end(), out_.begin.begin());
    out_.j.resize(out_.begin[n]);
    out_.rows.resize(out_.j.size());
    parallel_for(n, threads_, [&](int i) {
      int b = out_.begin[i];
      for (std::size_t pair = near_.begin[i]; pair < near_.begin[i + 1]; ++pair) {
        if (!is_selected(pair, back[pair])) continue;
        const int j = near_.j[pair];
        const Eigen::Vector2d X = vector_of<2>(initial_.x[j]) - vector_of<2>(initial_.x[i]);
        out_.j[b] = j;
        out_.rows[b].weight = selected_[pair] == not_selected ? 0 : selected_[pair];
        out_.rows[b].X = point_of<2>(X);
        const double per_r = spacing_ / X.norm();
        out_.rows[b].area =
            point_of<2>((irregular_[initial_.body[i]] ? even_share(per_r) : steep_share(per_r)) * X);
        ++b;
      }
    });
  }
  /// Irregular bodies are exempt: a few weak pairs do less harm there than no balance.
  std::vector<int> bodies_with_pair_below(double least) const {
    std::vector<unsigned char> below(initial_.size());
    parallel_for(initial_.size(), threads_, [&](int i) {
      below[i] = !is_rigid(constraints_[i]) && !irregular_[initial_.body[i]] && has_pair_below(least, i);
    });
    std::vector<int> bodies;
    for (int i = 0; i < initial_.size(); ++i)
      if (below[i] && (bodies.empty() || bodies.back() != initial_.body[i]))
        bodies.push_back(initial_.body[i]);
    return bodies;
  }
  bool has_pair_below(double least, int i) const {
    for (int b = out_.begin[i]; b < out_.begin[i + 1]; ++b) {
      const int j = out_.j[b];
      const int* last = out_.j.data() + out_.begin[j + 1];
      const int* back = std::find(last - (out_.begin[j + 1] - out_.begin[j]), last, i);
      const double of_other = initial_.V0[j] / initial_.V0[i] * out_.rows[back - out_.j.data()].weight;
      const bool enough = is_rigid(constraints_[j])
                              ? out_.rows[b].weight >= std::min(least, 0.0)  // other bonds carry the load
                              : out_.rows[b].weight + of_other >= least;
      if (!enough) return true;
    }
    return false;
  }

  const InitialParticles& initial_;
  const Constraints& constraints_;
  double spacing_, h_;
  int threads_;
  NeighborLists near_;
  std::vector<bool> irregular_;      // [body]
  std::vector<double> least_reach_;  // [body] in h
  std::vector<double> selected_;     // [pair of near_] weight, or not_selected
  std::vector<double> unbalanced_;
  bool changed_by_balance_ = false;
  Bonds out_;
};

}  // namespace

Bonds layout_bonds(const InitialParticles& initial, const Constraints& constraints, double spacing, double h,
                   int threads) {
  return LayoutBonds(initial, constraints, spacing, h, threads).make();
}

}  // namespace taut
