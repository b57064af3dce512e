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
  double xi = 0;                                          // from the first end to the second
  double distance2 = 0;                                   // m²
  double rank = std::numeric_limits<double>::infinity();  // m: the least is the foot
  double area = 0, slope = 0;  // that of the node, m, and what more of it a step along the segment brings
  Vec<double, Dim> offset{}, normal{};  // node − point, m; outwards
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
    find_sharp_ends();
  }

  const Outline& outline() const { return outline_; }
  int size() const { return outline_.size(); }
  const Outline::Segment& segment(int k) const { return outline_.segments[k]; }
  /// One begins where the other ends.
  bool beside(int k, int l) const {
    const auto &a = outline_.segments[k].node, &b = outline_.segments[l].node;
    return a[0] == b[1] || a[1] == b[0];
  }
  int body_of_segment(int k) const { return outline_.body_of(outline_.segments[k]); }
  V x0(int node) const {  // m
    V x;
    for (int k = 0; k < Dim; ++k) x[k] = outline_.x[node][k];
    return x;
  }

  /// After particles were stored in another order.
  void renumber(const State<Dim>& s) {
    const std::vector<int> where = s.places_of_ids();
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

  /// Takes a segment's point for the foot of a node if it is nearer and the node faces it. A face that no side of
  /// the node looks at straight counts as up to half its length further off: a corner that comes upon a corner is
  /// pushed back by the face before it. By the one beside it, which is as near, two tips went into each other, and
  /// the energy jumped when they had turned.
  void measure(int node, int k, Foot<Dim>& best) const {
    const std::array<int, 2>& end = outline_.segments[k].node;
    const V t = place_[end[1]] - place_[end[0]], d = place_[node] - place_[end[0]];
    const double along = dot(d, t) / dot(t, t);
    // beside a sharp end the face goes on, as far as it covers something
    const double xi = std::clamp(along, sharp_[k][0] ? std::min(along, 0.0) : 0.0,
                                 sharp_[k][1] ? std::max(along, 1.0) : 1.0);
    const V offset = d - xi * t;
    const double distance2 = dot(offset, offset);
    const double distance = std::sqrt(distance2);
    if (distance >= best.rank) return;
    const V normal = normal_of(k);
    double area = 0, straight = 0, slope = 0;
    for (const int side : outline_.beside[node]) {
      if (side == Outline::none) continue;
      const double share = facing_share(dot(normal_of(side), normal));
      const double half = 0.5 * outline_.segments[side].length * share;
      const Cover cover = covered(node, side, k, xi, t);
      area += half * cover.share, slope += half * cover.slope;
      straight = std::max(straight, share);
    }
    const double rank = distance + 0.5 * (1 - straight) * outline_.segments[k].length;
    if (area > 0 && rank < best.rank) best = {k, xi, distance2, rank, area, slope, offset, normal};
  }

  struct Touch {
    double depth;  // of the node behind the face, m; below 0 before it
    V out;         // unit vector along which the node is pushed, if it is behind
  };
  /// Beside an end that is not sharp, where two segments meet, the mean of their normals says which side is inside.
  Touch touch(const Foot<Dim>& foot) const {
    const bool second = foot.xi >= 1;
    if ((foot.xi > 0 && foot.xi < 1) || sharp_[foot.segment][second])
      return {-dot(foot.offset, foot.normal), foot.normal};
    const int next = outline_.beside[outline_.segments[foot.segment].node[second]][second];
    const V normal = next == Outline::none ? foot.normal : foot.normal + normal_of(next);
    const double distance = std::sqrt(foot.distance2);
    if (dot(foot.offset, normal) >= 0) return {-distance, foot.normal};
    return {distance, (-1 / distance) * foot.offset};
  }

  /// Of the place along a foot's segment: its slope in the node, and over that in the second end.
  std::array<V, 2> pushes(const Foot<Dim>& foot) const {
    const std::array<int, 2>& end = outline_.segments[foot.segment].node;
    const V t = place_[end[1]] - place_[end[0]];
    const double length = std::sqrt(dot(t, t));
    return {(1 / length) * t, (1 / length) * foot.offset};
  }

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    archive.fixed(stored_);
    archive.check("a particle of a face", [&] {
      return std::ranges::all_of(stored_, [&](int i) { return i >= 0 && i < particles; });
    });
  }

 private:
  struct Cover {
    double share = 1, slope = 0;  // slope: 1/m, along the segment
  };
  /// Of the half of segment `side` that belongs to a node, the share that lies over segment k, as far as that has
  /// sharp ends: two faces that slide off each other press with what there is of both.
  Cover covered(int node, int side, int k, double xi, const V& t) const {
    Cover cover;
    if (!sharp_[k][0] && !sharp_[k][1]) return cover;
    const double length = std::sqrt(dot(t, t));
    const auto& ends = outline_.segments[side].node;
    const V way = place_[ends[0] == node ? ends[1] : ends[0]] - place_[node];
    const double over = std::copysign(0.5 * outline_.segments[side].length, dot(way, t));  // along t, m
    for (const int end : {0, 1}) {
      if (!sharp_[k][end]) continue;
      const double from = (end == 0 ? xi : 1 - xi) * length, to = from + (end == 0 ? over : -over);
      const double u = std::clamp(std::max(from, to) / std::abs(over), 0.0, 1.0);
      const double share = u * u * (3 - 2 * u);  // faces of one length that lie on each other slide nowhere
      const double slope = (end == 0 ? 6 : -6) * u * (1 - u) / std::abs(over);
      cover = {cover.share * share, cover.slope * share + cover.share * slope};
    }
    return cover;
  }
  /// Ends where the face turns by more than 60 degrees, outwards.
  void find_sharp_ends() {
    for (int k = 0; k < static_cast<int>(outline_.segments.size()); ++k) {
      std::array<bool, 2>& sharp = sharp_.emplace_back();
      for (const int end : {0, 1}) {
        const int next = outline_.beside[outline_.segments[k].node[end]][end];
        if (next == Outline::none) continue;
        const V corner = x0(outline_.segments[k].node[end]), beyond = x0(outline_.segments[next].node[end]);
        const V n = normal_at_start(k);
        sharp[end] = dot(n, normal_at_start(next)) < 0.5 && dot(n, beyond - corner) < 0;
      }
    }
  }
  V normal_at_start(int k) const {
    const auto& [node, length, sense] = outline_.segments[k];
    const V t = x0(node[1]) - x0(node[0]);
    const double factor = sense / std::sqrt(dot(t, t));
    return {factor * t[1], -factor * t[0]};
  }

  Outline outline_;
  std::vector<std::array<bool, 2>> sharp_;  // [segment] its ends
  std::vector<int> stored_;                 // [share] where its particle is
  std::vector<int> behind_;                 // [node] the share of the particle behind it
  std::vector<V> place_;
};

}  // namespace taut::inline TAUT_ISA
