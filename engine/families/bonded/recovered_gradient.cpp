#include "engine/families/bonded/recovered_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <Eigen/Core>

#include "engine/core/least_squares.hpp"
#include "engine/core/parallel.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {
namespace {

constexpr double least_reach = 2.2, greatest_reach = 3.4, growth = 0.3;  // dp
constexpr double greatest_cost = 8;                                      // 1/dp

template <int Dim>
struct Neighbor {
  int id;
  Eigen::Vector<double, Dim> X;  // from i, in dp
};
template <int Dim>
using Neighborhood = std::vector<Neighbor<Dim>>;
template <int Dim>
constexpr int linear = Dim;  // terms
template <int Dim>
constexpr int quadratic = Dim + Dim*(Dim + 1) / 2;

/// Those of `near` that are of the same kind as i.
template <int Dim>
Neighborhood<Dim> alike(const InitialParticles& initial, int i, std::span<const int> near, double spacing) {
  Neighborhood<Dim> some;
  for (const int j : near) {
    if (initial.material[j] != initial.material[i] || initial.held[j] != initial.held[i]) continue;
    Eigen::Vector<double, Dim> X;
    for (int a = 0; a < Dim; ++a) X[a] = (initial.x[j][a] - initial.x[i][a]) / spacing;
    some.push_back({j, X});
  }
  return some;
}

template <int Dim>
Neighborhood<Dim> within(const Neighborhood<Dim>& near, double reach) {
  Neighborhood<Dim> some;
  some.reserve(near.size());
  std::ranges::copy_if(near, std::back_inserter(some),
                       [=](const Neighbor<Dim>& one) { return one.X.squaredNorm() < reach * reach; });
  return some;
}

/// Each neighbour has another one on the opposite side.
template <int Dim>
bool symmetric(const Neighborhood<Dim>& near) {
  constexpr double alike = 1e-6;
  return std::ranges::all_of(near, [&](const Neighbor<Dim>& one) {
    return std::ranges::any_of(
        near, [&](const Neighbor<Dim>& other) { return (one.X + other.X).squaredNorm() < alike * alike; });
  });
}

/// The rows g_j of the fit with the first `terms` of X, X ⊗ X, in 1/dp, a column for each; empty where the
/// fit is not determined or costs too much.
template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> fit(const Neighborhood<Dim>& near, int terms) {
  const auto n = static_cast<Eigen::Index>(near.size());
  if (n < terms) return {};
  Eigen::MatrixXd P(terms, n);  // times the root of the weight
  for (Eigen::Index b = 0; b < n; ++b) {
    const auto& X = near[b].X;
    int term = 0;
    for (int a = 0; a < Dim; ++a) P(term++, b) = X[a];
    for (int a = 0; a < Dim && term < terms; ++a)
      for (int c = a; c < Dim; ++c) P(term++, b) = X[a] * X[c];
    P.col(b) /= X.squaredNorm();
  }
  // the first rows of the pseudo-inverse of Pᵀ
  const auto [rows, rank] = least_squares(P, Eigen::MatrixXd::Identity(terms, Dim));
  if (rank < terms) return {};
  Eigen::Matrix<double, Dim, Eigen::Dynamic> g = rows.transpose();
  for (Eigen::Index b = 0; b < n; ++b) g.col(b) /= near[b].X.squaredNorm();
  for (int a = 0; a < Dim; ++a)
    if (!(g.row(a).cwiseAbs().sum() + std::abs(g.row(a).sum()) <= greatest_cost)) return {};
  return g;
}

/// The neighbours of a row and what they count, if there are any.
template <int Dim>
void add_row(const Neighborhood<Dim>& near, const std::vector<int>& where, double spacing,
             RecoveredGradient& out) {
  for (const int terms : {quadratic<Dim>, linear<Dim>}) {
    for (double reach = least_reach; reach <= greatest_reach; reach += growth) {
      const Neighborhood<Dim> some = within(near, reach);
      const auto g = fit<Dim>(some, terms);
      if (g.size() == 0) continue;
      for (std::size_t b = 0; b < some.size(); ++b) {
        Point g_j{};
        for (int a = 0; a < Dim; ++a) g_j[a] = g(a, b) / spacing;
        out.j.push_back(where[some[b].id]);
        out.g.push_back(g_j);
      }
      return;
    }
  }
}

template <int Dim>
RecoveredGradient recovered(const InitialParticles& initial, const std::vector<int>& id, double spacing,
                            double reach, int threads) {
  const int n = static_cast<int>(id.size());
  std::vector<int> where(id.size());
  for (int k = 0; k < n; ++k) where[id[k]] = k;
  const NeighborLists near =
      initial_neighbors(initial, std::max(1.001 * reach, greatest_reach * spacing), threads);
  // chunk by chunk, so that threads make rows of their own and their order is that of the particles
  constexpr int chunk = 1024;
  std::vector<RecoveredGradient> parts((id.size() + chunk - 1) / chunk);
  parallel_for(static_cast<int>(parts.size()), threads, [&](int part) {
    for (int k = chunk * part; k < std::min(n, chunk * (part + 1)); ++k) {
      const Neighborhood<Dim> kin = alike<Dim>(initial, id[k], near[id[k]], spacing);
      if (!initial.held[id[k]] && !symmetric(within(kin, (1 + 1e-9) * reach / spacing)))
        add_row(kin, where, spacing, parts[part]);
      parts[part].begin.push_back(static_cast<int>(parts[part].j.size()));
    }
  });
  RecoveredGradient out;
  out.begin.push_back(0);
  for (const RecoveredGradient& part : parts) {
    const int before = static_cast<int>(out.j.size());
    for (const int end : part.begin) out.begin.push_back(before + end);
    out.j.insert(out.j.end(), part.j.begin(), part.j.end());
    out.g.insert(out.g.end(), part.g.begin(), part.g.end());
  }
  return out;
}

}  // namespace

RecoveredGradient recovered_gradient(const InitialParticles& initial, const std::vector<int>& id,
                                     double spacing, double reach, int threads) {
  return initial.dim == 3 ? recovered<3>(initial, id, spacing, reach, threads)
                          : recovered<2>(initial, id, spacing, reach, threads);
}

}  // namespace taut
