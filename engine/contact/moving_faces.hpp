#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "engine/layout/outline.hpp"
#include "engine/solver/particles.hpp"
#include "engine/terms/surface_contact.hpp"

namespace taut {

/// Half of a side, next to a node, and its share that faces a segment.
struct FacingHalf {
  int side = Outline::none;
  double half = 0;              // initial length, m
  double share = 0, slope = 0;  // facing_share and its derivative by the cosine
  /// Place on the side above each sharp end of the segment: 0 at the node, 1 at the far end.
  std::array<double, 2> at{};
  std::array<double, 2> over{1, 1};  // share of the half inside each end, smoothed
  std::array<double, 2> rise{};      // derivative of `over` by `at`
  double past = 1;                   // 1 − facing_share of segment `next`
  double past_slope = 0;
  int next = Outline::none;

  double covered() const { return over[0] * over[1]; }
  double area() const { return half * share * covered() * past; }  // m
};

struct ClosestPoint {
  int node = Outline::none, segment = Outline::none;
  double xi = 0;
  double distance2 = 0;                                   // m²
  double rank = std::numeric_limits<double>::infinity();  // m; least wins
  double weight = 1;                                      // 0.5 for two equally near segments
  std::array<FacingHalf, 2> halves{};
  Vec<double, 2> offset{}, normal{};  // node − point, m; outward unit normal of the segment

  double area() const { return weight * (halves[0].area() + halves[1].area()); }  // m
};

class MovingFaces {
 public:
  using V = Vec<double, 2>;

  explicit MovingFaces(Outline outline)
      : outline_(std::move(outline)), place_(outline_.size()), normal_(outline_.segments.size()) {
    for (int n = 0; n < size(); ++n) {
      const auto first = outline_.shares.begin() + outline_.begin[n],
                 last = outline_.shares.begin() + outline_.begin[n + 1];
      const auto most = std::ranges::max_element(first, last, {}, &PointWeight::weight);
      main_share_.push_back(static_cast<int>(most - outline_.shares.begin()));
    }
    find_sharp_ends();
  }

  const Outline& outline() const { return outline_; }
  int size() const { return outline_.size(); }
  const Outline::Segment& segment(int k) const { return outline_.segments[k]; }
  bool beside(int k, int l) const {
    const auto &a = outline_.segments[k].node, &b = outline_.segments[l].node;
    return a[0] == b[1] || a[1] == b[0];
  }
  int body_of_segment(int k) const { return outline_.body_of(outline_.segments[k]); }
  V x0(int node) const {  // m
    V x;
    for (int k = 0; k < 2; ++k) x[k] = outline_.x[node][k];
    return x;
  }

  /// Call after reordering particles.
  void renumber(const Particles<2>& s) {
    const std::vector<int> where = s.places_of_ids();
    stored_.clear();
    for (const PointWeight& share : outline_.shares) stored_.push_back(where[share.particle]);
  }

  void place(const Particles<2>& s, int node) {
    V x{};
    for_each_share(node, [&](int i, double weight) { x += weight * s.x[i]; });
    place_[node] = x;
  }
  void place_all(const Particles<2>& s) {
    for (int n = 0; n < size(); ++n) place(s, n);
    for (int k = 0; k < static_cast<int>(normal_.size()); ++k) set_normal(k);
  }
  /// Requires current places of the nodes.
  void set_normal(int k) {
    const auto& [node, length, sense] = outline_.segments[k];
    const V t = place_[node[1]] - place_[node[0]];
    const double factor = sense / std::sqrt(dot(t, t));
    normal_[k] = {factor * t[1], -factor * t[0]};
  }
  const std::vector<V>& places() const { return place_; }  // [node] m
  /// Position of the particle of greatest weight of each node, m.
  void follow(const Particles<2>& s, std::vector<V>& x) const {
    x.clear();
    for (const int share : main_share_) x.push_back(s.x[stored_[share]]);
  }

  template <class F>
  void for_each_share(int node, const F& f) const {
    for (int k = outline_.begin[node]; k < outline_.begin[node + 1]; ++k)
      f(stored_[k], outline_.shares[k].weight);
  }

  const V& normal_of(int k) const { return normal_[k]; }

  bool has_sharp_end(int k) const { return sharp_[k][0] || sharp_[k][1]; }

  double distance2(int node, int k) const {
    const std::array<int, 2>& end = outline_.segments[k].node;
    const V t = place_[end[1]] - place_[end[0]], d = place_[node] - place_[end[0]];
    const V offset = d - std::clamp(dot(d, t) / dot(t, t), 0.0, 1.0) * t;
    return dot(offset, offset);
  }

  /// Initial length of the node's half sides, times facing_share, m.
  double facing(int node, const V& normal) const {
    double area = 0;
    for (const int k : outline_.beside[node])
      if (k != Outline::none)
        area += 0.5 * outline_.segments[k].length * facing_share(dot(normal_of(k), normal));
    return area;
  }

  /// Calls give(n, f) with the forces f on nodes n, in N, of the energy `energy` (in J/m) times facing(node, normal).
  template <class Give>
  void push_facing(int node, const V& normal, double energy, const Give& give) const {
    for (const int k : outline_.beside[node])
      if (k != Outline::none)
        if (const double slope = facing_slope(dot(normal_of(k), normal)); slope != 0)
          turn(k, normal, energy * 0.5 * outline_.segments[k].length * slope, give);
  }

  /// Replaces `best` by the closest point of segment k if the node faces the segment and the rank is lower. The rank is
  /// the distance plus up to half the segment's length for oblique sides: a corner is pushed back by the face in front
  /// of it, not beside it. Beyond a sharp end, the distance is the depth of the node's side at this end.
  void measure(int node, int k, ClosestPoint& best) const {
    const std::array<int, 2>& end = outline_.segments[k].node;
    const V t = place_[end[1]] - place_[end[0]], d = place_[node] - place_[end[0]];
    const double along = dot(d, t) / dot(t, t);
    const double xi = std::clamp(along, sharp_[k][0] ? std::min(along, 0.0) : 0.0,
                                 sharp_[k][1] ? std::max(along, 1.0) : 1.0);
    const V offset = d - xi * t;
    const double distance2 = dot(offset, offset);
    if (xi >= 0 && xi <= 1 && distance2 >= best.rank * best.rank) return;
    ClosestPoint closest;
    closest.node = node, closest.segment = k, closest.xi = xi, closest.distance2 = distance2;
    closest.offset = offset, closest.normal = normal_of(k);
    auto& [one, two] = closest.halves;
    one = facing_half(closest, outline_.beside[node][0]);
    two = facing_half(closest, outline_.beside[node][1]);
    if (!(closest.area() > 0)) return;
    if (is_beyond(closest)) (one.area() > two.area() ? two : one) = {};
    const double straight = std::max(one.share, two.share);
    const double distance =
        is_beyond(closest) ? std::abs(touch(closest).depth) : std::sqrt(closest.distance2);
    closest.rank = distance + 0.5 * (1 - straight) * outline_.segments[k].length;
    if (closest.rank < best.rank) best = closest;
  }

  /// `share`: factor of the energy; `slope`: its derivative by `cosine`; `cosine`: between the offset and
  /// normal_at_end, at a blunt end.
  struct Touch {
    double depth;  // behind the segment, m; negative in front
    V out;
    double share = 1, cosine = 0, slope = 0;
  };
  /// With `fades` the energy does not jump at blunt ends, so that the flanks of a crease gain no energy.
  Touch touch(const ClosestPoint& closest, bool fades = false) const {
    if (is_beyond(closest)) {
      const FacingHalf& half = closest.halves[closest.halves[0].side == Outline::none ? 1 : 0];
      return {depth_at(closest, half, closest.xi > 1), closest.normal};
    }
    const bool second = closest.xi >= 1;
    if ((closest.xi > 0 && closest.xi < 1) || sharp_[closest.segment][second])
      return {-dot(closest.offset, closest.normal), closest.normal};
    const V normal = normal_at_end(closest.segment, second);
    const double distance = std::sqrt(closest.distance2),
                 cosine = dot(closest.offset, normal) / (distance * std::sqrt(dot(normal, normal)));
    constexpr double across = -0.25, beside = -0.1, behind = -0.6;
    if (!fades)
      return cosine < across ? Touch{distance, (-1 / distance) * closest.offset}
                             : Touch{-distance, closest.normal};
    const double u = std::min((cosine - beside) / (behind - beside), 1.0);
    if (!(u > 0)) return {-distance, closest.normal};
    return {distance, (-1 / distance) * closest.offset, smooth_step(u), cosine,
            6 / (behind - beside) * u * (1 - u)};
  }

  double energy(const ClosestPoint& closest, const Touch& touch, double k, double reach) const {  // J
    return touch.share * near_energy(touch.depth, closest.area(), k, reach);
  }
  /// Calls own(n, f) with forces on the node's face and other(n, f) with forces on the segment's face, in N. `k`:
  /// stiffness, Pa/m; `reach`: depth at which contact has faded, m.
  template <class Own, class Other>
  void push(const ClosestPoint& closest, const Touch& touch, double k, double reach, const Own& own,
            const Other& other) const {
    const std::array<int, 2>& end = outline_.segments[closest.segment].node;
    const double size = touch.share * near_force(touch.depth, closest.area(), k, reach);
    if (touch.slope != 0)
      push_aside(closest, touch.cosine, touch.slope * near_energy(touch.depth, closest.area(), k, reach), own,
                 other);
    if (!is_beyond(closest)) {
      own(closest.node, size * touch.out);
      other(end[0], (-(1 - closest.xi) * size) * touch.out);
      other(end[1], (-closest.xi * size) * touch.out);
    }
    for (const FacingHalf& h : closest.halves) {
      if (!(h.share > 0)) continue;
      const double per_length = touch.share * near_energy(touch.depth, closest.weight, k, reach) * h.half;
      if (is_beyond(closest)) push_at_end(closest, h, touch.depth, size, own, other);
      for (const int e : {0, 1})
        if (h.rise[e] != 0)
          push_along(closest, h, e, per_length * h.share * h.past * h.over[1 - e] * h.rise[e], own, other);
      if (h.slope != 0)
        push_turning(h.side, closest.segment, per_length * h.slope * h.covered() * h.past, own, other);
      if (h.past_slope != 0)
        push_turning(h.side, h.next, per_length * h.share * h.covered() * h.past_slope, own, other);
    }
  }

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    archive.fixed(stored_);
    archive.check("a particle of a face", [&] {
      return std::ranges::all_of(stored_, [&](int i) { return i >= 0 && i < particles; });
    });
  }

 private:
  static bool is_beyond(const ClosestPoint& closest) { return closest.xi < 0 || closest.xi > 1; }

  int other_end(int node, int side) const {
    const auto& ends = outline_.segments[side].node;
    return ends[ends[0] == node ? 1 : 0];
  }
  V way(int node, int side) const { return place_[other_end(node, side)] - place_[node]; }

  FacingHalf facing_half(const ClosestPoint& closest, int side) const {
    FacingHalf h;
    if (side == Outline::none) return h;
    const auto [node, k, xi] = std::tuple(closest.node, closest.segment, closest.xi);
    const V normal = normal_of(side);
    const double cosine = dot(normal, closest.normal);
    h.side = side, h.half = 0.5 * outline_.segments[side].length;
    h.share = facing_share(cosine), h.slope = facing_slope(cosine);
    if (!(h.share > 0) || !has_sharp_end(k)) return h;
    const auto& ends = outline_.segments[k].node;
    const V t = place_[ends[1]] - place_[ends[0]], w = way(node, side);
    const double along = dot(t, w);
    for (const int e : {0, 1}) {
      if (!sharp_[k][e]) continue;
      h.at[e] = -dot(t, place_[node] - place_[ends[e]]) / along;
      const bool ahead = (along > 0) == (e == 0);
      const double u = std::clamp(ahead ? 1 - 2 * h.at[e] : 2 * h.at[e], 0.0, 1.0);
      h.over[e] = smooth_step(u);  // flat at 0 and 1, so that equal faces do not slide
      h.rise[e] = (ahead ? -12 : 12) * u * (1 - u);
    }
    if (xi >= 0 && xi <= 1) return h;
    const bool e = xi > 1;
    h.next = outline_.beside[ends[e]][e];
    const double to_next = dot(normal, normal_of(h.next));
    h.past = 1 - facing_share(to_next), h.past_slope = -facing_slope(to_next);
    return h;
  }

  /// Not a unit vector.
  V normal_at_end(int k, bool second) const {
    const int next = outline_.beside[outline_.segments[k].node[second]][second];
    return next == Outline::none ? normal_of(k) : normal_of(k) + normal_of(next);
  }

  double depth_at(const ClosestPoint& closest, const FacingHalf& h, int e) const {
    const V place = place_[closest.node] + h.at[e] * way(closest.node, h.side);
    return -dot(place - place_[outline_.segments[closest.segment].node[e]], closest.normal);
  }

  /// For segment t with end e, side w from x to z, crossing s and r = n·w/t·w:
  ///   δdepth = −(n − r t)·((1 − s) δx + s δz − δe) − r depth n·δt
  template <class Own, class Other>
  void push_at_end(const ClosestPoint& closest, const FacingHalf& h, double depth, double size,
                   const Own& own, const Other& other) const {
    const auto& ends = outline_.segments[closest.segment].node;
    const int e = closest.xi > 1;
    const V t = place_[ends[1]] - place_[ends[0]], w = way(closest.node, h.side);
    const double r = dot(closest.normal, w) / dot(t, w);
    const V out = closest.normal - r * t;
    own(closest.node, ((1 - h.at[e]) * size) * out);
    own(other_end(closest.node, h.side), (h.at[e] * size) * out);
    other(ends[e], -size * out);
    other(ends[1], (r * depth * size) * closest.normal);
    other(ends[0], (-r * depth * size) * closest.normal);
  }

  /// Applies the derivative of the energy by s: δs = −(t·((1 − s) δx + s δz − δe) − depth n·δt)/t·w.
  template <class Own, class Other>
  void push_along(const ClosestPoint& closest, const FacingHalf& h, int e, double slope, const Own& own,
                  const Other& other) const {
    const auto& ends = outline_.segments[closest.segment].node;
    const V t = place_[ends[1]] - place_[ends[0]];
    const double by = slope / dot(t, way(closest.node, h.side)), turning = by * depth_at(closest, h, e);
    own(closest.node, ((1 - h.at[e]) * by) * t);
    own(other_end(closest.node, h.side), (h.at[e] * by) * t);
    other(ends[e], -by * t);
    other(ends[1], -turning * closest.normal);
    other(ends[0], turning * closest.normal);
  }

  /// Applies the derivative of the energy by the cosine c between o, the offset from an end, and m, its normal_at_end:
  ///   δc = (m/|m| − c o/|o|)·δo/|o| + (o/|o| − c m/|m|)·δm/|m|
  template <class Own, class Other>
  void push_aside(const ClosestPoint& closest, double cosine, double slope, const Own& own,
                  const Other& other) const {
    const bool second = closest.xi >= 1;
    const int end = outline_.segments[closest.segment].node[second], next = outline_.beside[end][second];
    const V m = normal_at_end(closest.segment, second);
    const double length = std::sqrt(dot(m, m)), distance = std::sqrt(closest.distance2);
    const V to_node = (1 / distance) * closest.offset, along = (1 / length) * m;
    const V f = (slope / distance) * (along - cosine * to_node);
    own(closest.node, -1.0 * f), other(end, f);
    const V turning = (1 / length) * (to_node - cosine * along);
    turn(closest.segment, turning, slope, other);
    if (next != Outline::none) turn(next, turning, slope, other);
  }

  /// Applies the forces of the energy change slope normal·δn, where δn = −t n·δt/|t|².
  template <class Give>
  void turn(int side, const V& normal, double slope, const Give& give) const {
    const auto& ends = outline_.segments[side].node;
    const V t = place_[ends[1]] - place_[ends[0]];
    const V f = (slope * dot(t, normal) / dot(t, t)) * normal_of(side);
    give(ends[1], f), give(ends[0], -1.0 * f);
  }
  template <class Own, class Other>
  void push_turning(int side, int segment, double slope, const Own& own, const Other& other) const {
    turn(side, normal_of(segment), slope, own), turn(segment, normal_of(side), slope, other);
  }

  /// Marks ends at convex corners where the face turns by over 60°.
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
  std::vector<std::array<bool, 2>> sharp_;  // [segment][end]
  std::vector<int> stored_;                 // [share] storage index
  std::vector<int> main_share_;             // [node] share of greatest weight
  std::vector<V> place_;                    // [node] m
  std::vector<V> normal_;                   // [segment]
};

}  // namespace taut
