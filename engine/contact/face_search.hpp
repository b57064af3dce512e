#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "engine/contact/moving_faces.hpp"
#include "engine/neighbors/neighbors.hpp"

namespace taut {

/// Nodes, each with near segments of one body: segment[begin[k]] … segment[begin[k + 1] − 1].
struct NearFaces {
  std::vector<int> node, begin{0}, segment;

  template <class Archive>
  void serialize(Archive& archive, std::size_t nodes, std::size_t segments) {
    archive.indices(node, nodes);
    archive.rows(begin, node.size(), segment, segments);
  }
};

class FaceSearch {
 public:
  using V = Vec<double, 2>;

  /// Lists the segments with wanted(node, segment) that may be nearer than `listed` (in m). Returns a lower bound of
  /// the distance to all other wanted segments, at most `horizon`, in m.
  template <class Wanted>
  double operator()(const MovingFaces& faces, const std::vector<int>& nodes, const std::vector<int>& segments,
                    double listed, double horizon, const Wanted& wanted, NearFaces& out) {
    out = {};
    double beyond = horizon;
    if (nodes.empty() || segments.empty()) return beyond;
    const double half = 0.5 * sort_middles(faces, nodes, segments, horizon);
    const int count = static_cast<int>(segments.size());
    for (const int node : nodes) {
      const auto from = static_cast<std::ptrdiff_t>(out.segment.size());
      const V& x = faces.places()[node];
      grid_.for_each_row(x, [&](int first, int last) {
        for (int k = first; k < last; ++k) {
          const int at = (*order_)[k];
          if (at >= count) continue;
          const V d = x - middles_[at];
          const double apart2 = dot(d, d);
          if (apart2 >= (beyond + half) * (beyond + half) || !wanted(node, segments[at])) continue;
          const double distance = std::sqrt(apart2) - half;  // lower bound
          if (distance < listed)
            out.segment.push_back(segments[at]);
          else
            beyond = std::min(beyond, distance);
        }
      });
      std::sort(out.segment.begin() + from, out.segment.end());
      enter(faces, node, from, out);
    }
    return beyond;
  }

 private:
  /// Returns the length of the longest segment, m.
  double sort_middles(const MovingFaces& faces, const std::vector<int>& nodes,
                      const std::vector<int>& segments, double horizon) {
    middles_.clear();
    double longest2 = 0;
    for (const int k : segments) {
      const auto& [a, b] = faces.segment(k).node;
      const V t = faces.places()[b] - faces.places()[a];
      longest2 = std::max(longest2, dot(t, t));
      middles_.push_back(faces.places()[a] + 0.5 * t);
    }
    for (const int n : nodes) middles_.push_back(faces.places()[n]);
    const double longest = std::sqrt(longest2);
    order_ = &grid_.sort(middles_, horizon + 0.5 * longest);
    return longest;
  }

  static void enter(const MovingFaces& faces, int node, std::size_t from, NearFaces& out) {
    for (std::size_t k = from; k < out.segment.size(); ++k) {
      const auto body = [&](std::size_t l) { return faces.body_of_segment(out.segment[l]); };
      if (k + 1 < out.segment.size() && body(k + 1) == body(k)) continue;
      out.node.push_back(node);
      out.begin.push_back(static_cast<int>(k + 1));
    }
  }

  CellGrid<2> grid_;
  std::vector<V> middles_;
  const std::vector<int>* order_ = nullptr;
};

}  // namespace taut
