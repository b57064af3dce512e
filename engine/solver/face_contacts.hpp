#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "engine/error.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/scene/outline.hpp"
#include "engine/solver/motion_bound.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/solver/state.hpp"
#include "engine/solver/wall_contacts.hpp"
#include "engine/terms/surface_contact.hpp"

namespace taut::inline TAUT_ISA {

/// What faces of bodies do to each other where they overlap, by the law of terms/surface_contact.hpp. The
/// faces are those of scene/outline.hpp: a node is a mean of particles, and each node is pushed to its closest
/// point of the other face, which is pushed back. A force on a node goes to its particles by their weights,
/// and one on a segment to its two nodes by ξ: so both momenta are kept, and the force is the slope of an
/// energy but for what the share of a corner (facing_share) does where it changes.
///
/// Own faces of a body count, if the input says so, for segments that were further than `far_apart` from a
/// node at the start: a body that folds meets itself.
template <int Dim>
class FaceContacts {
 public:
  using V = Vec<double, Dim>;

  explicit FaceContacts(const SolverInput& input);

  /// The segments that may act before the next search. `search` does it after the particles have been stored
  /// in another order; `prepare` where the next way of the fastest particle, m, asks for it: true if it did.
  void search(const State<Dim>& s, const WallContacts<Dim>& walls);
  bool prepare(const State<Dim>& s, const WallContacts<Dim>& walls, double way);

  /// Particles that may get a force, in rising order.
  const std::vector<int>& touching() const { return touching_; }

  /// Sets the forces on `touching`, N (per metre depth in 2D); what walls give in `dt`, s, is booked.
  void evaluate(const State<Dim>& s, double dt, WallContacts<Dim>& walls, std::vector<V>& force);
  double energy(const State<Dim>& s, const WallContacts<Dim>& walls);  // J (per metre depth in 2D)

  /// Least signed distance of a node of one of two bodies from a face of the other, m, below 0 where they
  /// overlap; at least `reach` where they are further apart.
  double gap(const State<Dim>& s, int a, int b);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(slot_, others_, own_, near_wall_, others_bound_, own_bound_, watched_, touching_);
  }

 private:
  // in spacings
  static constexpr double reach = 1;      // a node that is further behind a face is not of this contact
  static constexpr double skin = 1;       // longer: fewer searches, more pairs
  static constexpr double horizon = 4;    // how far a search looks, for how long it may hold
  static constexpr double far_apart = 4;  // the two faces of a thinner wall do not act on each other

  /// Nodes, each with segments of one body near it.
  struct Near {
    std::vector<int> node, begin, segment;

    void clear() { node.clear(), segment.clear(), begin.assign(1, 0); }
    template <class Archive>
    void serialize(Archive& archive) {
      archive(node, begin, segment);
    }
  };
  /// The closest point of a segment to a node.
  struct Foot {
    int segment = Outline::none;
    double xi = 0;                                               // from the first end to the second
    double distance2 = std::numeric_limits<double>::infinity();  // m²
    double area = 0;                                             // that of the node, m
    V offset{}, normal{};                                        // node − point, m; outwards

    V along(const V& a, const V& b) const { return (1 - xi) * a + xi * b; }
  };
  struct Touch {
    double depth;  // m, below 0 outside
    V out;         // unit vector on which the node is pushed
  };

  void refuse_thin(const Scene& scene) const;
  V x0(int node) const;
  void place(const State<Dim>& s, int node);
  void place_all(const State<Dim>& s) {
    for (int n = 0; n < outline_.size(); ++n) place(s, n);
  }
  V normal_of(int segment) const;
  double facing(int node, const V& normal) const;
  void measure_from(int node, int segment, Foot& best) const;
  Touch touch(const Foot& foot) const;
  double stiffness(int node, int segment) const;

  void renumber(const State<Dim>& s);
  void search_others(const WallContacts<Dim>& walls);
  std::vector<int> nodes_near_others() const;
  void search_own();
  template <class Wanted>
  double find(const std::vector<int>& nodes, const std::vector<int>& segments, const Wanted& wanted,
              Near& out);
  void watch();
  template <class F>
  void for_each_foot(const Near& near, const F& f) const;
  template <class F>
  void for_each_wall(const WallContacts<Dim>& walls, const F& f) const;

  Outline outline_;
  double dp_, stiffness_;
  bool meets_itself_, meets_others_;  // others: bodies or walls
  double per_way_ = 1;                // greatest way of a node where no particle goes further than 1
  std::vector<double> M_;             // [node] Pa
  std::vector<int> all_nodes_, all_segments_;

  std::vector<int> slot_;  // [share] where the particle is stored
  std::vector<V> place_;   // [node] of those that are watched, m
  Near others_, own_;
  std::vector<std::pair<int, int>> near_wall_;  // (node, wall)
  MotionBound<Dim> others_bound_, own_bound_;
  std::vector<int> watched_;   // nodes whose place counts, in rising order
  std::vector<int> touching_;  // particles
  // [node] N; apart, so that each is summed in the order of nodes, which mirrored bodies share
  std::vector<V> own_force_;  // from what the nodes of its own body meet
  std::vector<V> reaction_;   // from nodes of other bodies

  CellGrid<Dim> grid_;
};

template <int Dim>
FaceContacts<Dim>::FaceContacts(const SolverInput& input)
    : dp_(input.constants.dp),
      stiffness_(input.constants.contact_stiffness),
      meets_itself_(input.meets_itself),
      meets_others_(input.scene.bodies.size() > 1 || !input.scene.walls.empty()) {
  others_.clear();
  own_.clear();
  if (input.contact != ContactLaw::surface) return;
  outline_ = make_outline(input.scene, input.initial);
  refuse_thin(input.scene);
  for (int n = 0; n < outline_.size(); ++n) {
    double way = 0;
    for (int k = outline_.begin[n]; k < outline_.begin[n + 1]; ++k)
      way += std::abs(outline_.shares[k].weight);
    per_way_ = std::max(per_way_, way);
    const Elasticity& e = input.materials[outline_.material[n]];
    M_.push_back(e.K + 4.0 / 3 * e.G);
    all_nodes_.push_back(n);
  }
  for (std::size_t k = 0; k < outline_.segments.size(); ++k) all_segments_.push_back(static_cast<int>(k));
  others_bound_ = own_bound_ = MotionBound<Dim>(per_way_);
  place_.resize(outline_.size());
  own_force_.resize(outline_.size());
  reaction_.resize(outline_.size());
}

template <int Dim>
void FaceContacts<Dim>::refuse_thin(const Scene& scene) const {
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
    if (std::ranges::binary_search(outline_.body, b)) continue;
    throw SceneError("contact", "the contact law 'surface' needs faces, and body '" + scene.bodies[b].name +
                                    "' is too thin to have one: use a smaller spacing or another law");
  }
}

template <int Dim>
auto FaceContacts<Dim>::x0(int node) const -> V {
  V x;
  for (int k = 0; k < Dim; ++k) x[k] = outline_.x[node][k];
  return x;
}

template <int Dim>
void FaceContacts<Dim>::place(const State<Dim>& s, int node) {
  V x{};
  for (int k = outline_.begin[node]; k < outline_.begin[node + 1]; ++k)
    x += outline_.shares[k].weight * s.x[slot_[k]];
  place_[node] = x;
}

/// Of length 1, outwards.
template <int Dim>
auto FaceContacts<Dim>::normal_of(int segment) const -> V {
  const auto& [node, length, sense] = outline_.segments[segment];
  const V t = place_[node[1]] - place_[node[0]];
  const double factor = sense / std::sqrt(dot(t, t));
  return {factor * t[1], -factor * t[0]};
}

/// The length of face that belongs to a node, m at the start, as far as it faces a face of this normal.
template <int Dim>
double FaceContacts<Dim>::facing(int node, const V& normal) const {
  double area = 0;
  for (const int segment : outline_.beside[node])
    if (segment != Outline::none)
      area += 0.5 * outline_.segments[segment].length * facing_share(dot(normal_of(segment), normal));
  return area;
}

template <int Dim>
void FaceContacts<Dim>::measure_from(int node, int segment, Foot& best) const {
  const std::array<int, 2>& end = outline_.segments[segment].node;
  const V t = place_[end[1]] - place_[end[0]], d = place_[node] - place_[end[0]];
  const double xi = std::clamp(dot(d, t) / dot(t, t), 0.0, 1.0);
  const V offset = d - xi * t;
  const double distance2 = dot(offset, offset);
  if (distance2 >= best.distance2) return;
  const V normal = normal_of(segment);
  const double area = facing(node, normal);
  if (area > 0) best = {segment, xi, distance2, area, offset, normal};
}

/// Beside an end, where two segments meet, the mean of their normals says which side is inside.
template <int Dim>
auto FaceContacts<Dim>::touch(const Foot& foot) const -> Touch {
  if (foot.xi > 0 && foot.xi < 1) return {-dot(foot.offset, foot.normal), foot.normal};
  V normal = foot.normal;
  const bool second = foot.xi > 0;
  const int next = outline_.beside[outline_.segments[foot.segment].node[second]][second];
  if (next != Outline::none) normal += normal_of(next);
  const double distance = std::sqrt(foot.distance2);
  if (dot(foot.offset, normal) >= 0) return {-distance, normal};
  return {distance, (-1 / distance) * foot.offset};
}

template <int Dim>
double FaceContacts<Dim>::stiffness(int node, int segment) const {
  const std::array<int, 2>& end = outline_.segments[segment].node;
  return surface_stiffness(M_[node], 0.5 * (M_[end[0]] + M_[end[1]]), stiffness_, dp_);
}

template <int Dim>
void FaceContacts<Dim>::renumber(const State<Dim>& s) {
  std::vector<int> where(s.size());
  for (int i = 0; i < s.size(); ++i) where[s.id[i]] = i;
  slot_.clear();
  for (const PointWeight& share : outline_.shares) slot_.push_back(where[share.particle]);
}

template <int Dim>
void FaceContacts<Dim>::search(const State<Dim>& s, const WallContacts<Dim>& walls) {
  if (outline_.size() == 0) return;
  renumber(s);
  place_all(s);
  if (meets_others_) search_others(walls);
  if (meets_itself_) search_own();
  watch();
}

template <int Dim>
bool FaceContacts<Dim>::prepare(const State<Dim>& s, const WallContacts<Dim>& walls, double way) {
  if (outline_.size() == 0) return false;
  const bool others = meets_others_ && !others_bound_.holds(way);
  bool own = meets_itself_ && !own_bound_.holds(way);
  if (others || own) place_all(s);
  if (others) {
    search_others(walls);
    others_bound_.holds(way);
  }
  own = own && !own_bound_.still_holds(place_, outline_.body, way);
  if (own) {
    search_own();
    own_bound_.holds(way);
  }
  if (others || own) watch();
  return others || own;
}

/// Lists the wanted segments less than reach + skin from the nodes; how far the nearest other one is, m, up
/// to the horizon.
template <int Dim>
template <class Wanted>
double FaceContacts<Dim>::find(const std::vector<int>& nodes, const std::vector<int>& segments,
                               const Wanted& wanted, Near& out) {
  out.clear();
  double beyond = horizon * dp_, longest = 0;
  if (nodes.empty() || segments.empty()) return beyond;
  std::vector<V> middles;  // and the nodes, so that they are in the grid
  for (const int segment : segments) {
    const V &a = place_[outline_.segments[segment].node[0]], &b = place_[outline_.segments[segment].node[1]];
    middles.push_back(0.5 * (a + b));
    longest = std::max(longest, dot(a - b, a - b));
  }
  const int count = static_cast<int>(segments.size());
  for (const int node : nodes) middles.push_back(place_[node]);
  const double listed = (reach + skin) * dp_, half = 0.5 * std::sqrt(longest);
  const std::vector<int>& order = grid_.sort(middles, horizon * dp_ + half);
  for (const int node : nodes) {
    const auto from = static_cast<std::ptrdiff_t>(out.segment.size());
    grid_.for_each_row(place_[node], [&](int first, int last) {
      for (int k = first; k < last; ++k) {
        if (order[k] >= count) continue;
        const int segment = segments[order[k]];
        const V d = place_[node] - middles[order[k]];
        const double least = std::sqrt(dot(d, d)) - half;  // it is no nearer
        if (least >= beyond || !wanted(node, segment)) continue;
        (least < listed ? out.segment.push_back(segment) : void(beyond = least));
      }
    });
    std::sort(out.segment.begin() + from, out.segment.end());
    for (std::size_t k = from; k < out.segment.size(); ++k) {  // an entry for each body
      const auto body = [&](std::size_t l) { return outline_.body_of(outline_.segments[out.segment[l]]); };
      if (k + 1 < out.segment.size() && body(k + 1) == body(k)) continue;
      out.node.push_back(node);
      out.begin.push_back(static_cast<int>(k + 1));
    }
  }
  return beyond;
}

/// Those in the box of another body, widened by what a search looks at.
template <int Dim>
std::vector<int> FaceContacts<Dim>::nodes_near_others() const {
  const int bodies = 1 + outline_.body.back();
  std::vector<V> low(bodies), high(bodies);
  std::vector<bool> begun(bodies);
  for (const int n : all_nodes_) {
    const int b = outline_.body[n];
    if (!begun[b]) low[b] = high[b] = place_[n];
    begun[b] = true;
    for (int k = 0; k < Dim; ++k)
      low[b][k] = std::min(low[b][k], place_[n][k]), high[b][k] = std::max(high[b][k], place_[n][k]);
  }
  const double margin = (horizon + 2) * dp_;  // 2: a segment has an end within its length
  const auto near = [&](int n) {
    for (int b = 0; b < bodies; ++b) {
      bool in = begun[b] && b != outline_.body[n];
      for (int k = 0; k < Dim && in; ++k)
        in = place_[n][k] > low[b][k] - margin && place_[n][k] < high[b][k] + margin;
      if (in) return true;
    }
    return false;
  };
  std::vector<int> nodes;
  std::ranges::copy_if(all_nodes_, std::back_inserter(nodes), near);
  return nodes;
}

/// What is near a wall is listed as far as it lasts as long.
template <int Dim>
void FaceContacts<Dim>::search_others(const WallContacts<Dim>& walls) {
  const std::vector<int> nodes = nodes_near_others();
  std::vector<int> segments;
  std::ranges::copy_if(all_segments_, std::back_inserter(segments), [&](int k) {
    const std::array<int, 2>& end = outline_.segments[k].node;
    return std::ranges::binary_search(nodes, end[0]) || std::ranges::binary_search(nodes, end[1]);
  });
  const auto wanted = [&](int n, int k) {
    return outline_.body_of(outline_.segments[k]) != outline_.body[n];
  };
  others_bound_.restart(find(nodes, segments, wanted, others_) - reach * dp_, {});
  near_wall_.clear();
  for (const int n : all_nodes_)
    for (int w = 0; w < walls.count(); ++w)
      if (walls.height(w, place_[n]) < 0.5 * horizon * dp_) near_wall_.emplace_back(n, w);
}

template <int Dim>
void FaceContacts<Dim>::search_own() {
  const double least2 = far_apart * far_apart * dp_ * dp_;
  const auto wanted = [&](int n, int k) {
    if (outline_.body_of(outline_.segments[k]) != outline_.body[n]) return false;
    for (const int end : outline_.segments[k].node) {
      const V d = x0(n) - x0(end);
      if (dot(d, d) <= least2) return false;
    }
    return true;
  };
  own_bound_.restart(find(all_nodes_, all_segments_, wanted, own_) - reach * dp_, place_);
}

/// Nodes that are listed or stand beside one, and their particles.
template <int Dim>
void FaceContacts<Dim>::watch() {
  std::vector<bool> seen(outline_.size());
  const auto with_neighbors = [&](int n) {
    seen[n] = true;
    for (const int segment : outline_.beside[n])
      if (segment != Outline::none)
        for (const int end : outline_.segments[segment].node) seen[end] = true;
  };
  for (const Near* near : {&others_, &own_}) {
    for (const int n : near->node) with_neighbors(n);
    for (const int segment : near->segment)
      for (const int end : outline_.segments[segment].node) with_neighbors(end);
  }
  for (const auto& [n, wall] : near_wall_) with_neighbors(n);
  watched_.clear();
  touching_.clear();
  for (const int n : all_nodes_) {
    if (!seen[n]) continue;
    watched_.push_back(n);
    touching_.insert(touching_.end(), slot_.begin() + outline_.begin[n],
                     slot_.begin() + outline_.begin[n + 1]);
  }
  std::sort(touching_.begin(), touching_.end());
  touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
}

/// f(node, foot) of each listed node.
template <int Dim>
template <class F>
void FaceContacts<Dim>::for_each_foot(const Near& near, const F& f) const {
  for (std::size_t k = 0; k < near.node.size(); ++k) {
    Foot best;
    for (int l = near.begin[k]; l < near.begin[k + 1]; ++l) measure_from(near.node[k], near.segment[l], best);
    if (best.segment != Outline::none) f(near.node[k], best);
  }
}

/// f(node, wall, depth, area, k): its mirror image lies twice as deep behind it, and half of the energy of
/// the two is its own.
template <int Dim>
template <class F>
void FaceContacts<Dim>::for_each_wall(const WallContacts<Dim>& walls, const F& f) const {
  for (const auto& [n, wall] : near_wall_) {
    const double height = walls.height(wall, place_[n]);
    if (height >= 0) continue;
    const double area = facing(n, walls.normal(wall));
    if (area > 0) f(n, wall, -2 * height, area, surface_stiffness(M_[n], M_[n], stiffness_, dp_));
  }
}

template <int Dim>
void FaceContacts<Dim>::evaluate(const State<Dim>& s, double dt, WallContacts<Dim>& walls,
                                 std::vector<V>& force) {
  for (const int n : watched_) {
    place(s, n);
    own_force_[n] = reaction_[n] = V{};
  }
  const auto push = [&](int n, const Foot& foot, std::vector<V>& reaction) {
    const auto [depth, out] = touch(foot);
    if (depth >= reach * dp_) return;
    const double size = surface_force(depth, foot.area, stiffness(n, foot.segment));
    if (size == 0) return;
    const std::array<int, 2>& end = outline_.segments[foot.segment].node;
    own_force_[n] += size * out;
    reaction[end[0]] -= ((1 - foot.xi) * size) * out;
    reaction[end[1]] -= (foot.xi * size) * out;
  };
  for_each_foot(others_, [&](int n, const Foot& foot) { push(n, foot, reaction_); });
  for_each_foot(own_, [&](int n, const Foot& foot) { push(n, foot, own_force_); });
  for_each_wall(walls, [&](int n, int wall, double depth, double area, double k) {
    // 2: of the pass over the node and of that over its image
    const V f = (2 * surface_force(depth, area, k)) * walls.normal(wall);
    own_force_[n] += f;
    for (int l = outline_.begin[n]; l < outline_.begin[n + 1]; ++l) {
      const int i = slot_[l];
      walls.book(s.x[i], (dt * s.mobile[i] * outline_.shares[l].weight) * f);
    }
  });
  for (const int i : touching_) force[i] = V{};
  for (const int n : watched_) {
    const V f = own_force_[n] + reaction_[n];
    for (int l = outline_.begin[n]; l < outline_.begin[n + 1]; ++l)
      force[slot_[l]] += outline_.shares[l].weight * f;
  }
}

template <int Dim>
double FaceContacts<Dim>::energy(const State<Dim>& s, const WallContacts<Dim>& walls) {
  for (const int n : watched_) place(s, n);
  double sum = 0;
  for (const Near* near : {&others_, &own_}) {
    for_each_foot(*near, [&](int n, const Foot& foot) {
      const double depth = touch(foot).depth;
      if (depth < reach * dp_) sum += surface_energy(depth, foot.area, stiffness(n, foot.segment));
    });
  }
  for_each_wall(walls, [&](int, int, double depth, double area, double k) {
    sum += surface_energy(depth, area, k);  // both passes, half of them of the image
  });
  return sum;
}

template <int Dim>
double FaceContacts<Dim>::gap(const State<Dim>& s, int a, int b) {
  for (const int n : watched_) place(s, n);
  double least = reach * dp_;
  for_each_foot(others_, [&](int n, const Foot& foot) {
    const int own = outline_.body[n], other = outline_.body_of(outline_.segments[foot.segment]);
    if ((own == a && other == b) || (own == b && other == a)) least = std::min(least, -touch(foot).depth);
  });
  return least;
}

}  // namespace taut::inline TAUT_ISA
