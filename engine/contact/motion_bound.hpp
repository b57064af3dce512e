#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/tensor.hpp"
#include "engine/materials/rotated_piola.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Bounds the approach of two points since the last search by twice the path of the fastest point. `still_holds`
/// replaces this path by the greatest deviation from the rigid motion of each body.
template <int Dim>
class MotionBound {
 public:
  using V = Vec<double, Dim>;

  /// `free`: allowed approach of two points [m]; `x`: positions, body after body [m].
  void restart(double free, std::vector<V> x) {
    free_ = free;
    gone_ = 0;
    from_ = std::move(x);
  }

  /// Call before points move by at most `way` (in m). If false, call `still_holds` or search.
  bool holds(double way) {
    gone_ += way;
    return 2 * gone_ <= free_;
  }

  /// `x`: positions before the motion by `way` [m].
  bool still_holds(const std::vector<V>& x, const std::vector<int>& body, double way) {
    gone_ = 0;
    const std::size_t n = x.size();
    for (std::size_t first = 0, last; first < n; first = last) {
      V middle{}, from{};
      for (last = first; last < n && body[last] == body[first]; ++last)
        middle += x[last], from += from_[last];
      const double share = 1 / static_cast<double>(last - first);
      middle = share * middle, from = share * from;
      Mat<double, Dim> turn{};
      double square = 0;
      for (std::size_t k = first; k < last; ++k) {
        const V a = from_[k] - from, b = x[k] - middle;
        square += dot(a, a);
        for (int i = 0; i < Dim; ++i)
          for (int j = 0; j < Dim; ++j) turn(i, j) += b[i] * a[j];
      }
      if (square > 0) turn = nearest_rotation((1 / square) * turn);
      for (std::size_t k = first; k < last; ++k) {
        const V a = turn * (from_[k] - from);
        const V d = x[k] - middle - a;
        gone_ = std::max(gone_, dot(d, d));
      }
    }
    gone_ = std::sqrt(gone_);
    constexpr double worthwhile = 0.75;  // of `free_`
    return 2 * gone_ <= worthwhile * free_ && holds(way);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(free_, gone_);
    archive.fixed(from_);
  }

 private:
  double free_ = 0, gone_ = 0;  // m
  std::vector<V> from_;         // m
};

inline constexpr TermInfo self_contact_info{
    "self-contact",
    "the law of contact, between particles initially more than 4 dp apart (faces in 2D: 3 dp; "
    "facets through the body: 8 dp)",
    "ours", "contact/motion_bound.hpp:MotionBound",
    "contact: closing arms of oenog, tl and pf-jst do not pass through each other under any law"};

}  // namespace taut
