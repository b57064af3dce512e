#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/scene/outline.hpp"
#include "engine/solver/state.hpp"
#include "engine/terms/surface_contact.hpp"

namespace taut::inline TAUT_ISA {

/// The closest point of a segment to a node.
template <int Dim>
struct Foot {
  int segment = Outline::none;
  double xi = 0;                                               // from the first end to the second
  double distance2 = std::numeric_limits<double>::infinity();  // m²
  double area = 0;                                             // that of the node, m
  Vec<double, Dim> offset{}, normal{};                         // node − point, m; outwards
};

/// Where the faces of scene/outline.hpp are now: a node is a mean of particles, and what acts on a node acts
/// on them by the same weights.
template <int Dim>
class MovingFaces {
 public:
  using V = Vec<double, Dim>;

  MovingFaces() = default;
  explicit MovingFaces(Outline outline) : outline_(std::move(outline)), place_(outline_.size()) {
    for (int n = 0; n < size(); ++n) {
      const auto first = outline_.shares.begin() + outline_.begin[n],
                 last = outline_.shares.begin() + outline_.begin[n + 1];
      const auto most = std::ranges::max_element(first, last, {}, &PointWeight::weight);
      behind_.push_back(static_cast<int>(most - outline_.shares.begin()));
    }
  }

  const Outline& outline() const { return outline_; }
  int size() const { return outline_.size(); }
  const Outline::Segment& segment(int k) const { return outline_.segments[k]; }
  int body_of_segment(int k) const { return outline_.body_of(outline_.segments[k]); }
  V x0(int node) const {  // m
    V x;
    for (int k = 0; k < Dim; ++k) x[k] = outline_.x[node][k];
    return x;
  }

  /// After particles were stored in another order.
  void renumber(const State<Dim>& s) {
    std::vector<int> where(s.size());
    for (int i = 0; i < s.size(); ++i) where[s.id[i]] = i;
    stored_.clear();
    for (const PointWeight& share : outline_.shares) stored_.push_back(where[share.particle]);
  }

  /// Brings nodes to where their particles are.
  void place(const State<Dim>& s, int node) {
    V x{};
    for_each_share(node, [&](int i, double weight) { x += weight * s.x[i]; });
    place_[node] = x;
  }
  void place_all(const State<Dim>& s) {
    for (int n = 0; n < size(); ++n) place(s, n);
  }
  const std::vector<V>& places() const { return place_; }  // [node] m
  /// The place of the particle that counts most for each node, m.
  void follow(const State<Dim>& s, std::vector<V>& x) const {
    x.clear();
    for (const int share : behind_) x.push_back(s.x[stored_[share]]);
  }

  /// f(i, weight) for each stored particle that a node is a mean of.
  template <class F>
  void for_each_share(int node, const F& f) const {
    for (int k = outline_.begin[node]; k < outline_.begin[node + 1]; ++k)
      f(stored_[k], outline_.shares[k].weight);
  }

  /// Of length 1, outwards.
  V normal_of(int k) const {
    const auto& [node, length, sense] = outline_.segments[k];
    const V t = place_[node[1]] - place_[node[0]];
    const double factor = sense / std::sqrt(dot(t, t));
    return {factor * t[1], -factor * t[0]};
  }

  /// The length of face that belongs to a node, m at the start, as far as it faces a face of this normal.
  double facing(int node, const V& normal) const {
    double area = 0;
    for (const int k : outline_.beside[node])
      if (k != Outline::none)
        area += 0.5 * outline_.segments[k].length * facing_share(dot(normal_of(k), normal));
    return area;
  }

  /// Takes a segment's point for the foot of a node if it is nearer and the node faces it.
  void measure(int node, int k, Foot<Dim>& best) const {
    const std::array<int, 2>& end = outline_.segments[k].node;
    const V t = place_[end[1]] - place_[end[0]], d = place_[node] - place_[end[0]];
    const double xi = std::clamp(dot(d, t) / dot(t, t), 0.0, 1.0);
    const V offset = d - xi * t;
    const double distance2 = dot(offset, offset);
    if (distance2 >= best.distance2) return;
    const V normal = normal_of(k);
    const double area = facing(node, normal);
    if (area > 0) best = {k, xi, distance2, area, offset, normal};
  }

  struct Touch {
    double depth;  // of the node behind the face, m; below 0 before it
    V out;         // unit vector along which the node is pushed, if it is behind
  };
  /// Beside an end, where two segments meet, the mean of their normals says which side is inside.
  Touch touch(const Foot<Dim>& foot) const {
    if (foot.xi > 0 && foot.xi < 1) return {-dot(foot.offset, foot.normal), foot.normal};
    const bool second = foot.xi > 0;
    const int next = outline_.beside[outline_.segments[foot.segment].node[second]][second];
    const V normal = next == Outline::none ? foot.normal : foot.normal + normal_of(next);
    const double distance = std::sqrt(foot.distance2);
    if (dot(foot.offset, normal) >= 0) return {-distance, foot.normal};
    return {distance, (-1 / distance) * foot.offset};
  }

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    archive.fixed(stored_);
    archive.check("a particle of a face", [&] {
      return std::ranges::all_of(stored_, [&](int i) { return i >= 0 && i < particles; });
    });
  }

 private:
  Outline outline_;
  std::vector<int> stored_;  // [share] where its particle is
  std::vector<int> behind_;  // [node] the share of the particle behind it
  std::vector<V> place_;
};

}  // namespace taut::inline TAUT_ISA
