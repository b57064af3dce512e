#include "engine/methods/bonded/layout/recovered_gradient.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <Eigen/Core>

#include "engine/core/growth.hpp"
#include "engine/core/least_squares.hpp"
#include "engine/core/parallel.hpp"
#include "engine/layout/material_point.hpp"
#include "engine/neighbors/linked.hpp"
#include "engine/neighbors/neighbors_of_one.hpp"

namespace taut {
namespace {

constexpr double least_reach = 2.2, greatest_reach = 3.4, growth = 0.3;  // dp
constexpr double greatest_cost = 8;                                      // 1/dp

template <int Dim>
struct Neighbor {
  int id;
  Eigen::Vector<double, Dim> X;  // from i, dp
};
template <int Dim>
using Neighborhood = std::vector<Neighbor<Dim>>;
template <int Dim>
constexpr int linear = Dim;  // terms
template <int Dim>
constexpr int quadratic = Dim + Dim*(Dim + 1) / 2;

template <int Dim>
Neighborhood<Dim> within(const Neighborhood<Dim>& near, double reach) {
  Neighborhood<Dim> some;
  some.reserve(near.size());
  std::ranges::copy_if(near, std::back_inserter(some),
                       [=](const Neighbor<Dim>& one) { return one.X.squaredNorm() < reach * reach; });
  return some;
}

template <int Dim>
void leave_out_unlinked(Neighborhood<Dim>& near) {
  taut::leave_out_unlinked(
      near, [](const Neighbor<Dim>& one) { return one.X.squaredNorm(); },
      [](const Neighbor<Dim>& one, const Neighbor<Dim>& other) { return (one.X - other.X).squaredNorm(); });
}

constexpr int rigid = 1;
/// 0 free, 1 rigid, else a number per drive or guide (THEORY.md, Recovered gradient).
template <int Dim>
std::vector<int> motions(const InitialParticles& initial, const Constraints& constraints,
                         const std::vector<int>& drive, double spacing, int threads) {
  constexpr int first = 2, guides = 8;
  const auto guide = [&](int i) { return initial.guided.empty() ? 0U : initial.guided[i]; };
  const auto prescribed = [&](int i) {  // drives override guides
    if (drive[i] >= 0) return first + guides * (drive[i] + 1);
    return guide(i) == 0 ? 0 : first + static_cast<int>(guide(i));
  };
  const auto bound = [&](int i) { return drive[i] >= 0 ? Dim + 1 : std::popcount(guide(i)); };
  std::vector<int> motion(initial.size());
  bool any = false, all = true;
  for (int i = 0; i < initial.size(); ++i) {
    motion[i] = is_rigid(constraints[i]) ? rigid : prescribed(i);
    any |= motion[i] > rigid;
    all &= motion[i] == motion[0];
  }
  if (!any || all) return motion;
  const NeighborsOfOne<Dim> neighbors(initial, link_of_neighbors * spacing);
  parallel_for(initial.size(), threads, [&](int i) {
    if (motion[i] == rigid || bound(i) == 0) return;
    int freest = i;
    for (const int j : neighbors(i))
      if (!is_rigid(constraints[j]) && initial.material[j] == initial.material[i] && bound(j) < bound(freest))
        freest = j;
    motion[i] = prescribed(freest);
  });
  return motion;
}

/// X is rounded to 2^-40 dp, to share rows on lattices.
template <int Dim>
Neighborhood<Dim> alike(const InitialParticles& initial, const std::vector<int>& motion, int i,
                        std::span<const int> near, double spacing) {
  Neighborhood<Dim> some;
  some.reserve(near.size());
  for (const int j : near) {
    if (initial.material[j] != initial.material[i] || motion[j] != motion[i]) continue;
    Eigen::Vector<double, Dim> X;
    for (int a = 0; a < Dim; ++a)
      X[a] = std::round((initial.x[j][a] - initial.x[i][a]) / spacing * 0x1p40) * 0x1p-40;
    some.push_back({j, X});
  }
  return some;
}

template <int Dim>
bool has_other_side(const InitialParticles& initial, const std::vector<int>& motion, int i,
                    std::span<const int> near, double reach) {
  return std::ranges::any_of(near, [&](int j) {
    const bool other = initial.material[j] != initial.material[i] ||
                       (motion[j] != motion[i] && motion[j] != rigid && motion[i] != rigid);
    double r2 = 0;
    for (int a = 0; other && a < Dim; ++a) r2 += std::pow(initial.x[j][a] - initial.x[i][a], 2);
    return other && r2 < reach * reach;
  });
}

template <int Dim>
bool is_symmetric(const Neighborhood<Dim>& near) {
  constexpr double alike = 1e-6;
  const auto is_opposite = [](const Neighbor<Dim>& one, const Neighbor<Dim>& other) {
    return (one.X + other.X).squaredNorm() < alike * alike;
  };
  // on a lattice the first neighbour is opposite to the last
  if (std::equal(near.begin(), near.end(), near.rbegin(), is_opposite)) return true;
  return std::ranges::all_of(near, [&](const Neighbor<Dim>& one) {
    return std::ranges::any_of(near, [&](const Neighbor<Dim>& other) { return is_opposite(one, other); });
  });
}

/// g in 1/dp; empty if undetermined or too sensitive.
template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> fit(const Neighborhood<Dim>& near, int terms) {
  const auto n = static_cast<Eigen::Index>(near.size());
  if (n < terms) return {};
  Eigen::MatrixXd P(terms, n);  // times √weight
  for (Eigen::Index b = 0; b < n; ++b) {
    const auto& X = near[b].X;
    int term = 0;
    for (int a = 0; a < Dim; ++a) P(term++, b) = X[a];
    for (int a = 0; a < Dim && term < terms; ++a)
      for (int c = a; c < Dim; ++c) P(term++, b) = X[a] * X[c];
    P.col(b) /= X.squaredNorm();
  }
  // first rows of the pseudo-inverse of Pᵀ
  Eigen::Matrix<double, Dim, Eigen::Dynamic> g;
  const Gram G = P.lazyProduct(P.transpose());
  if (const Gram fast = solved_by_gram(G, Gram::Identity(terms, Dim)); fast.size() > 0) {
    g = fast.transpose().lazyProduct(P);
  } else {
    const auto [rows, rank] = least_squares(P, Eigen::MatrixXd::Identity(terms, Dim));
    if (rank < terms) return {};
    g = rows.transpose();
  }
  for (Eigen::Index b = 0; b < n; ++b) g.col(b) /= near[b].X.squaredNorm();
  for (int a = 0; a < Dim; ++a)
    if (!(g.row(a).cwiseAbs().sum() + std::abs(g.row(a).sum()) <= greatest_cost)) return {};
  return g;
}

template <int Dim>
class Rows {
 public:
  Rows(const InitialParticles& initial, const Constraints& constraints, const std::vector<int>& drive,
       const std::vector<int>& id, double spacing, double reach, bool halved, int threads)
      : initial_(initial),
        id_(id),
        spacing_(spacing),
        halved_(halved),
        motion_(motions<Dim>(initial, constraints, drive, spacing, threads)),
        where_(id.size()),
        own_(initial, std::max((1 + 1e-9) * reach, least_reach * spacing)),
        own_reach_((1 + 1e-9) * reach / spacing),
        wide_(initial, greatest_reach * spacing) {
    for (std::size_t k = 0; k < id.size(); ++k) where_[id[k]] = static_cast<int>(k);
    out_.dim = Dim;
    out_.begin.push_back(0);
  }

  struct Row {
    std::vector<int> j;
    std::vector<double> g;
    bool between = false;
  };
  /// Thread-safe.
  Row make(int k) const {
    Row row;
    const int i = id_[k];
    if (motion_[i] == rigid) return row;
    const std::vector<int> near = own_(i);
    Neighborhood<Dim> own = alike<Dim>(initial_, motion_, i, near, spacing_);
    if constexpr (Dim == 3)
      row.between =
          has_other_side<Dim>(initial_, motion_, i, near, std::min(own_reach_, link_of_neighbors) * spacing_);
    if (is_symmetric(within(own, std::max(own_reach_, link_of_neighbors)))) return row;
    leave_out_unlinked(own);
    if (fit_to(within(own, least_reach), quadratic<Dim>, row)) return row;
    Neighborhood<Dim> wide = alike<Dim>(initial_, motion_, i, wide_(i), spacing_);
    leave_out_unlinked(wide);
    for (const int terms : {quadratic<Dim>, linear<Dim>})
      for (double reach = least_reach; reach <= greatest_reach; reach += growth)
        if (fit_to(within(wide, reach), terms, row)) return row;
    return row;
  }
  void take(int k, const Row& row) {
    const auto done = static_cast<std::size_t>(k);
    make_room(out_.j, row.j.size(), done, id_.size());
    out_.j.insert(out_.j.end(), row.j.begin(), row.j.end());
    out_.begin.push_back(static_cast<int>(out_.j.size()));
    if (row.between) {
      out_.between.resize(id_.size());
      out_.between[done] = 1;
    }
    out_.row.push_back(halved_ ? append(out_.halved, row, done) : shared(row, done));
  }
  RecoveredGradient finish() { return std::move(out_); }

 private:
  bool fit_to(const Neighborhood<Dim>& near, int terms, Row& row) const {
    const auto g = fit<Dim>(near, terms);
    if (g.size() == 0) return false;
    for (std::size_t b = 0; b < near.size(); ++b) {
      row.j.push_back(where_[near[b].id]);
      for (int a = 0; a < Dim; ++a) row.g.push_back(g(a, b) / spacing_);
    }
    return true;
  }
  template <class Number>
  int append(std::vector<Number>& list, const Row& row, std::size_t done) {
    make_room(list, row.g.size(), done, id_.size());
    list.insert(list.end(), row.g.begin(), row.g.end());
    return static_cast<int>(list.size() - row.g.size());
  }
  int shared(const Row& row, std::size_t done) {
    if (Dim == 2 || row.g.empty()) return append(out_.g, row, done);
    const char* const bytes = reinterpret_cast<const char*>(row.g.data());
    const auto hash = std::hash<std::string_view>()({bytes, row.g.size() * sizeof(double)});
    for (auto [at, end] = known_.equal_range(hash); at != end; ++at)
      if (at->second + row.g.size() <= out_.g.size() &&
          std::equal(row.g.begin(), row.g.end(), out_.g.begin() + at->second))
        return at->second;
    return known_.emplace(hash, append(out_.g, row, done))->second;
  }

  const InitialParticles& initial_;
  const std::vector<int>& id_;
  double spacing_;
  bool halved_;
  std::vector<int> motion_;
  std::vector<int> where_;
  NeighborsOfOne<Dim> own_;
  double own_reach_;  // dp
  NeighborsOfOne<Dim> wide_;
  std::unordered_multimap<std::size_t, int> known_;  // hash → row
  RecoveredGradient out_;
};

template <int Dim>
RecoveredGradient recovered(const InitialParticles& initial, const Constraints& constraints,
                            const std::vector<int>& drive, const std::vector<int>& id, double spacing,
                            double reach, int threads, bool halved) {
  Rows<Dim> rows(initial, constraints, drive, id, spacing, reach, halved, threads);
  make_in_order(
      static_cast<int>(id.size()), threads, [&](int k) { return rows.make(k); },
      [&](int k, const auto& row) { rows.take(k, row); });
  return rows.finish();
}

}  // namespace

RecoveredGradient recovered_gradient(const InitialParticles& initial, const Constraints& constraints,
                                     const std::vector<int>& drive, const std::vector<int>& id,
                                     double spacing, double reach, int threads, bool halved) {
  const auto of_dim = initial.dim == 3 ? recovered<3> : recovered<2>;
  return of_dim(initial, constraints, drive, id, spacing, reach, threads, halved);
}

}  // namespace taut
