#include "engine/diagnostics/alternating_part.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <Eigen/Core>

#include "engine/core/growth.hpp"
#include "engine/core/kernels_of.hpp"
#include "engine/core/least_squares.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/point.hpp"
#include "engine/diagnostics/kernels.hpp"
#include "engine/neighbors/close_pairs.hpp"
#include "engine/neighbors/linked.hpp"

namespace taut {
namespace {

constexpr double reach = 2.1;  // in dp

/// Least |(I − P) e_i|² of a particle with weights.
constexpr double least_left = 0.3;

/// κ (THEORY.md).
double scale(int dim) { return dim == 3 ? std::sqrt(207.0 / 170) * 85 / 128 : std::sqrt(11.0 / 8) / 2; }

bool alike(const Snapshot& now, std::size_t i, std::size_t j) {
  return now.material[i] == now.material[j] && now.clamped[i] == now.clamped[j];
}

/// Similar particles in range; the particle itself comes first.
struct Neighborhoods {
  std::vector<std::size_t> begin;  // [particle + 1]
  std::vector<int> all;

  std::span<int> operator[](std::size_t i) { return {&all[begin[i]], begin[i + 1] - begin[i]}; }
};

void exclude_across_slots(const Snapshot& start, double spacing, int threads, Neighborhoods& near) {
  const auto squared = [&](int i, int j) {
    const double r = distance_between(start.initial(static_cast<std::size_t>(i)),
                                      start.initial(static_cast<std::size_t>(j)), start.dim) /
                     spacing;
    return r * r;
  };
  std::vector<std::size_t> linked(start.size());
  parallel_for(static_cast<int>(start.size()), threads, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    linked[k] = bring_linked_to_front(
        near[k].subspan(1), [&](int j) { return squared(i, j); }, squared);
  });
  std::size_t end = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const std::span<const int> own = near[i].first(linked[i] + 1);
    near.begin[i] = end;
    if (own.data() != &near.all[end]) std::ranges::copy(own, &near.all[end]);
    end += own.size();
  }
  near.begin.back() = end;
}

Neighborhoods neighborhoods(const Snapshot& start, double spacing, int threads) {
  const double radius = reach * spacing;
  const auto for_each_pair = [&](const auto& visit) {
    for_each_close_pair(
        start, radius,
        [&](int i, int j) {
          if (alike(start, static_cast<std::size_t>(i), static_cast<std::size_t>(j))) visit(i, j);
        },
        threads);
  };
  Neighborhoods near;
  near.begin.assign(start.size() + 1, 1);
  near.begin[0] = 0;
  for_each_pair([&](int i, int j) { ++near.begin[i + 1], ++near.begin[j + 1]; });
  std::partial_sum(near.begin.begin(), near.begin.end(), near.begin.begin());
  near.all.resize(near.begin.back());
  std::vector<std::size_t> end(near.begin.begin(), near.begin.end() - 1);
  for (std::size_t i = 0; i < start.size(); ++i) near.all[end[i]++] = static_cast<int>(i);
  for_each_pair([&](int i, int j) { near.all[end[i]++] = j, near.all[end[j]++] = i; });
  exclude_across_slots(start, spacing, threads, near);
  return near;
}

/// Monomials up to degree 2 about the first particle, in dp.
Eigen::MatrixXd quadratics(const Snapshot& start, std::span<const int> near, double spacing) {
  const int dim = start.dim;
  const Point xi = start.initial(static_cast<std::size_t>(near[0]));
  Eigen::MatrixXd M(near.size(), (dim + 1) * (dim + 2) / 2);
  for (Eigen::Index k = 0; k < M.rows(); ++k) {
    const Point xj = start.initial(static_cast<std::size_t>(near[k]));
    Eigen::Index column = 0;
    M(k, column++) = 1;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
      M(k, column++) = (xj[a] - xi[a]) / spacing;
    for (int a = 1; a <= dim; ++a)
      for (int b = a; b <= dim; ++b) M(k, column++) = M(k, a) * M(k, b);
  }
  return M;
}

/// κ (I − P) e_i / |(I − P) e_i|; empty below `least_left`.
Eigen::VectorXd row(const Eigen::MatrixXd& quadratics, double kappa) {
  const Eigen::VectorXd e_i = Eigen::VectorXd::Unit(quadratics.rows(), 0);
  const Gram G = quadratics.transpose().lazyProduct(quadratics);
  const Gram fast = solved_by_gram(G, quadratics.row(0).transpose());
  const Eigen::VectorXd coefficients =
      fast.size() > 0 ? Eigen::VectorXd(fast) : Eigen::VectorXd(least_squares(quadratics, e_i).x);
  const Eigen::VectorXd left = e_i - quadratics.lazyProduct(coefficients);
  if (left[0] < least_left) return {};  // left[0] = |left|²
  return kappa / left.norm() * left;
}

std::vector<int> surroundings(const Snapshot& start, std::span<const int> near, double spacing) {
  constexpr double fine = 1e6;
  const Point xi = start.initial(static_cast<std::size_t>(near[0]));
  std::vector<int> places;
  for (const int j : near) {
    const Point xj = start.initial(static_cast<std::size_t>(j));
    for (std::size_t a = 0; a < 3; ++a)
      places.push_back(static_cast<int>(std::lround(fine * (xj[a] - xi[a]) / spacing)));
  }
  return places;
}

/// In 3D equal rows share weights: lattices have few different rows.
class Rows {
 public:
  Rows(const Snapshot& start, double spacing, Neighborhoods& near)
      : start_(start), spacing_(spacing), kappa_(scale(start.dim)), near_(near) {}

  struct Made {
    std::vector<int> surroundings;  // in 3D
    std::optional<Eigen::VectorXd> weights;
  };
  Made make(std::span<int> near) const {
    if (start_.dim == 2) return {{}, weights(near)};
    std::ranges::sort(near.begin() + 1, near.end());
    Made made{surroundings(start_, near, spacing_), {}};
    if (!known_.empty() && known(made.surroundings) < 0) made.weights = weights(near);
    return made;
  }

  void add(std::span<const int> near, const Made& made) {
    const int like = start_.dim == 3 ? known(made.surroundings) : -1;
    const int first = like >= 0      ? part_.first_weight[static_cast<std::size_t>(like)]
                      : made.weights ? add_weights(*made.weights)
                                     : add_weights(weights(near));
    if (first < 0) return;
    if (start_.dim == 3 && like < 0) known_.emplace(hash_of(made.surroundings), part_.rows());
    std::ranges::copy(near, near_.all.begin() + part_.begin.back());
    part_.first_weight.push_back(first);
    part_.begin.push_back(part_.begin.back() + static_cast<int>(near.size()));
  }

  AlternatingPart take() {
    near_.all.resize(static_cast<std::size_t>(part_.begin.back()));
    part_.j.swap(near_.all);
    return std::move(part_);
  }

 private:
  Eigen::VectorXd weights(std::span<const int> near) const {
    return row(quadratics(start_, near, spacing_), kappa_);
  }
  int add_weights(const Eigen::VectorXd& w) {
    if (w.size() == 0) return -1;
    make_room(part_.weight, static_cast<std::size_t>(w.size()), part_.first_weight.size(), start_.size());
    part_.weight.insert(part_.weight.end(), w.begin(), w.end());
    return static_cast<int>(part_.weight.size()) - static_cast<int>(w.size());
  }

  static std::size_t hash_of(const std::vector<int>& places) {
    return std::hash<std::string_view>()(
        {reinterpret_cast<const char*>(places.data()), places.size() * sizeof(int)});
  }
  int known(const std::vector<int>& places) const {
    for (auto [at, end] = known_.equal_range(hash_of(places)); at != end; ++at) {
      const auto row = static_cast<std::size_t>(at->second);
      const std::span<const int> near(near_.all.begin() + part_.begin[row],
                                      near_.all.begin() + part_.begin[row + 1]);
      if (surroundings(start_, near, spacing_) == places) return at->second;
    }
    return -1;
  }

  const Snapshot& start_;
  double spacing_, kappa_;
  Neighborhoods& near_;
  AlternatingPart part_{{0}, {}, {}, {}};
  std::unordered_multimap<std::size_t, int> known_;
};

}  // namespace

AlternatingPart alternating_part(const Snapshot& start, double spacing, int threads) {
  Neighborhoods near = neighborhoods(start, spacing, threads);
  Rows rows(start, spacing, near);
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < start.size(); ++i)
    if (start.clamped[i] == 0) moving.push_back(i);
  const auto near_of = [&](int k) { return near[moving[static_cast<std::size_t>(k)]]; };
  make_in_order(
      static_cast<int>(moving.size()), threads, [&](int k) { return rows.make(near_of(k)); },
      [&](int k, const Rows::Made& made) { rows.add(near_of(k), made); });
  return rows.take();
}

AlternatingSums alternating_sums(const AlternatingPart& part, const Snapshot& now, double spacing) {
  double out[6];
  std::vector<double> x(static_cast<std::size_t>(part.rows()));
  best_kernels<SharedKernels::history_row, HistoryKernels>(now.dim).alternating_sums(
      {part.rows(), part.begin.data(), part.j.data(), part.first_weight.data(), part.weight.data()},
      view_of(now), spacing, out, x.data());
  return {std::move(x), {out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
}

}  // namespace taut
