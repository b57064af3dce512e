#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include "engine/contact/moving_facets.hpp"
#include "engine/core/pack.hpp"

namespace taut {

enum class PairsOf {
  one_body,  // initially farther apart than `far`
  two_bodies,
};

/// Columns with `lanes` readable entries after the last one.
struct FacetColumns {
  const double* now[3];    // m
  const double* start[3];  // m
  const double* normal[3];
};

/// Finds the facets q among first … last − 1 with |x_q − x_p|² < near2, |X_q − X_p|² > far2 and n_q · n_p < cosine.
/// Stores indices and squared distances [m²].
inline int find_near_facets(const FacetColumns& facets, int p, int first, int last, double near2, double far2,
                            double cosine, int* found, double* distance2) {
  int count = 0;
  for (int q = first; q < last; q += lanes) {
    Pack d2{}, D2{}, cosines{};
    for (int k = 0; k < 3; ++k) {
      const Pack d = load(facets.now[k] + q) - facets.now[k][p],
                 D = load(facets.start[k] + q) - facets.start[k][p];
      d2 += d * d, D2 += D * D;
      cosines += load(facets.normal[k] + q) * facets.normal[k][p];
    }
    const unsigned in_row = last - q < lanes ? (1u << (last - q)) - 1 : (1u << lanes) - 1;
    unsigned near = in_row & lanes_where((d2 < near2) & (cosines < cosine) & (D2 > far2));
    for (; near != 0; near &= near - 1) {
      const int lane = __builtin_ctz(near);
      found[count] = q + lane, distance2[count++] = d2[lane];
    }
  }
  return count;
}

class FacetPairs {
 public:
  using V = Vec<double, 3>;

  FacetPairs() = default;
  /// A cluster contains facets in a cell of this width (in m) with similar initial normals.
  FacetPairs(const MovingFacets& facets, double width) {
    using Key = std::tuple<int, int, bool, std::array<double, 3>>;
    std::vector<Key> key;
    for (int f = 0; f < facets.size(); ++f) {
      const auto& [x, n, area] = facets[f];
      start_.push_back(x);
      body_.push_back(facets.body(f));
      int axis = 0;
      for (int k = 1; k < 3; ++k)
        if (std::abs(n[k]) > std::abs(n[axis])) axis = k;
      key.emplace_back(
          facets.body(f), axis, n[axis] > 0,
          std::array{std::floor(x[2] / width), std::floor(x[1] / width), std::floor(x[0] / width)});
    }
    order_.resize(key.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::ranges::stable_sort(order_, {}, [&](int f) -> const Key& { return key[f]; });
    cluster_.resize(key.size());
    for (std::size_t p = 1; p < order_.size(); ++p)
      cluster_[order_[p]] = cluster_[order_[p - 1]] + (key[order_[p]] != key[order_[p - 1]] ? 1 : 0);
  }

  int size() const { return static_cast<int>(body_.size()); }
  const std::vector<int>& order() const { return order_; }
  const V& start(int facet) const { return start_[facet]; }  // m
  const std::vector<int>& bodies() const { return body_; }   // [facet]

  struct Limits {
    double listed, horizon;  // m
    double far;              // least initial distance in one body, m
    double cosine;           // greatest cosine of the normals
  };
  /// Calls found(f, g) once for each pair with wanted(f, g) nearer than `listed`. Returns the distance of the nearest
  /// other wanted pair, at most `horizon`, in m. `candidates`: in the order of `order()`.
  template <PairsOf kind, class Wanted, class Found>
  double find(const MovingFacets& facets, const std::vector<int>& candidates, const Limits& limits,
              const Wanted& wanted, const Found& found) {
    gather(facets, candidates);
    double beyond2 = limits.horizon * limits.horizon;
    const int count = static_cast<int>(begin_.size()) - 1;
    for (int a = 0; a < count; ++a) {
      const double body = of_body_[begin_[a]];
      for (int b = a; b < count; ++b) {
        const bool same = of_body_[begin_[b]] == body;
        if (kind == PairsOf::one_body && !same) break;
        if (kind == PairsOf::two_bodies && same) continue;
        if (!may_meet(a, b, beyond2, limits.cosine)) continue;
        find_between<kind>(candidates, a, b, limits, beyond2, wanted, found);
      }
    }
    return std::sqrt(beyond2);
  }

 private:
  struct Cluster {
    V low, high;    // m
    V normal;       // mean
    double spread;  // greatest deviation from `normal`
  };

  static constexpr double room = 1e-9;  // tolerance of rounding

  bool may_meet(int a, int b, double apart2, double cosine) const {
    const Cluster &A = clusters_[a], &B = clusters_[b];
    double gap2 = 0;
    for (int k = 0; k < 3; ++k) {
      const double gap = std::max({A.low[k] - B.high[k], B.low[k] - A.high[k], 0.0});
      gap2 += gap * gap;
    }
    if (gap2 > apart2 * (1 + room)) return false;
    const double least = dot(A.normal, B.normal) - A.spread * std::sqrt(dot(B.normal, B.normal)) -
                         B.spread * std::sqrt(dot(A.normal, A.normal)) - A.spread * B.spread;
    return least < cosine + room;
  }

  template <PairsOf kind, class Wanted, class Found>
  void find_between(const std::vector<int>& candidates, int a, int b, const Limits& limits, double& beyond2,
                    const Wanted& wanted, const Found& found) {
    const double far2 = kind == PairsOf::one_body ? limits.far * limits.far : -1;
    for (int p = begin_[a]; p < begin_[a + 1]; ++p) {
      const int count = find_near_facets(columns_, p, a == b ? p + 1 : begin_[b], begin_[b + 1], beyond2,
                                         far2, limits.cosine, near_.data(), distance2_.data());
      for (int k = 0; k < count; ++k) {
        const int f = candidates[p], g = candidates[near_[k]];
        if (!wanted(f, g)) continue;
        if (distance2_[k] < limits.listed * limits.listed)
          found(f, g);
        else
          beyond2 = std::min(beyond2, distance2_[k]);
      }
    }
  }

  void gather(const MovingFacets& facets, const std::vector<int>& candidates) {
    const std::size_t n = candidates.size();
    for (auto* columns : {&now_, &then_, &normal_})
      for (auto& column : *columns) column.resize(n + lanes);
    of_body_.resize(n);
    begin_.clear();
    clusters_.clear();
    for (std::size_t p = 0; p < n; ++p) {
      const int f = candidates[p];
      const auto& [x, normal, area] = facets[f];
      for (int k = 0; k < 3; ++k) now_[k][p] = x[k], then_[k][p] = start_[f][k], normal_[k][p] = normal[k];
      of_body_[p] = body_[f];
      if (p == 0 || cluster_[f] != cluster_[candidates[p - 1]]) {
        begin_.push_back(static_cast<int>(p));
        clusters_.push_back({x, x, {}, 0});
      }
      Cluster& c = clusters_.back();
      for (int k = 0; k < 3; ++k) c.low[k] = std::min(c.low[k], x[k]), c.high[k] = std::max(c.high[k], x[k]);
      c.normal += normal;
    }
    begin_.push_back(static_cast<int>(n));
    for (int k = 0; k < 3; ++k) {
      columns_.now[k] = now_[k].data(), columns_.start[k] = then_[k].data();
      columns_.normal[k] = normal_[k].data();
    }
    near_.resize(n), distance2_.resize(n);
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
      clusters_[c].normal = (1.0 / (begin_[c + 1] - begin_[c])) * clusters_[c].normal;
      double spread2 = 0;
      for (int p = begin_[c]; p < begin_[c + 1]; ++p) {
        const V d = facets[candidates[p]].normal - clusters_[c].normal;
        spread2 = std::max(spread2, dot(d, d));
      }
      clusters_[c].spread = std::sqrt(spread2);
    }
  }

  std::vector<V> start_;  // [facet] initial midpoint, m
  std::vector<int> body_, cluster_;
  std::vector<int> order_;
  std::array<std::vector<double>, 3> now_, then_;  // [candidate] m
  std::array<std::vector<double>, 3> normal_;      // [candidate]
  FacetColumns columns_{};
  std::vector<int> near_;
  std::vector<double> distance2_;  // m²
  std::vector<int> of_body_;
  std::vector<int> begin_;
  std::vector<Cluster> clusters_;
};

}  // namespace taut
