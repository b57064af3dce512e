// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/solver/contact/face_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>

#include "engine/error.hpp"

namespace taut::inline TAUT_ISA {

namespace {

/// K + 4G/3 at a node, Pa: between two materials a mean, as its place is.
double modulus(const Outline& outline, int node, const SolverInput& input) {
  double sum = 0, weights = 0, least = std::numeric_limits<double>::infinity(), most = 0;
  for (int k = outline.begin[node]; k < outline.begin[node + 1]; ++k) {
    const Elasticity& e = input.materials[input.initial.material[outline.shares[k].particle]];
    const double M = e.K + 4.0 / 3 * e.G, weight = std::abs(outline.shares[k].weight);
    sum += weight * M, weights += weight;
    least = std::min(least, M), most = std::max(most, M);
  }
  return least == most ? most : sum / weights;
}

}  // namespace

template <int Dim>
FaceContacts<Dim>::FaceContacts(const SolverInput& input)
    : dp_(input.constants.dp),
      stiffness_(input.constants.contact_stiffness),
      meets_itself_(input.meets_itself),
      meets_others_(input.scene.bodies.size() > 1 || !input.scene.walls.empty()) {
  if (input.contact != ContactLaw::surface) return;
  faces_ = MovingFaces<Dim>(make_outline(input.scene, input.initial));
  if (meets_others_) refuse_thin(input.scene);
  const Outline& outline = faces_.outline();
  for (int n = 0; n < outline.size(); ++n) M_.push_back(modulus(outline, n, input));
  all_nodes_.resize(outline.size());
  std::iota(all_nodes_.begin(), all_nodes_.end(), 0);
  all_segments_.resize(outline.segments.size());
  std::iota(all_segments_.begin(), all_segments_.end(), 0);
  own_force_.resize(outline.size());
  reaction_.resize(outline.size());
}

template <int Dim>
void FaceContacts<Dim>::refuse_thin(const Scene& scene) const {
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
    if (std::ranges::binary_search(faces_.outline().body, b)) continue;
    throw SceneError("body." + scene.bodies[b].name,
                     "the contact law 'surface' needs faces, and body '" + scene.bodies[b].name +
                         "' is too thin to have one: use a smaller spacing or another law");
  }
}

template <int Dim>
void FaceContacts<Dim>::search(const Particles<Dim>& s, const WallContacts<Dim>& walls) {
  if (faces_.size() == 0) return;
  faces_.renumber(s);
  faces_.place_all(s);
  if (meets_others_) search_others(walls);
  if (meets_itself_) search_own(s);
  watch();
}

template <int Dim>
bool FaceContacts<Dim>::prepare(const Particles<Dim>& s, const WallContacts<Dim>& walls, double way) {
  if (faces_.size() == 0) return false;
  const bool others = meets_others_ && !others_bound_.holds(way);
  bool own = meets_itself_ && !own_bound_.holds(way);
  if (own) faces_.follow(s, behind_);
  own = own && !own_bound_.still_holds(behind_, faces_.outline().body, way);
  if (others || own) faces_.place_all(s);
  if (others) {
    search_others(walls);
    others_bound_.holds(way);
  }
  if (own) {
    search_own(s);
    own_bound_.holds(way);
  }
  if (others || own) watch();
  return others || own;
}

/// Which nodes are in the box of another body, widened by what a search looks at.
template <int Dim>
std::vector<char> FaceContacts<Dim>::near_others() const {
  const std::vector<int>& body = faces_.outline().body;
  const int bodies = 1 + body.back();
  std::vector<V> low(bodies), high(bodies);
  std::vector<bool> begun(bodies);
  for (const int n : all_nodes_) {
    const V& x = faces_.places()[n];
    V &l = low[body[n]], &h = high[body[n]];
    if (!begun[body[n]]) l = h = x;
    begun[body[n]] = true;
    for (int k = 0; k < Dim; ++k) l[k] = std::min(l[k], x[k]), h[k] = std::max(h[k], x[k]);
  }
  const double margin = (horizon + 2) * dp_;  // 2: a segment has an end within its length
  std::vector<char> near(all_nodes_.size());
  for (const int n : all_nodes_) {
    const V& x = faces_.places()[n];
    for (int b = 0; b < bodies && !near[n]; ++b) {
      bool in = b != body[n];
      for (int k = 0; k < Dim && in; ++k) in = x[k] > low[b][k] - margin && x[k] < high[b][k] + margin;
      near[n] = in;
    }
  }
  return near;
}

/// What is near a wall is listed as far as the search of the others lasts.
template <int Dim>
void FaceContacts<Dim>::search_others(const WallContacts<Dim>& walls) {
  const std::vector<char> near = near_others();
  std::vector<int> nodes, segments;
  std::ranges::copy_if(all_nodes_, std::back_inserter(nodes), [&](int n) { return near[n]; });
  std::ranges::copy_if(all_segments_, std::back_inserter(segments), [&](int k) {
    const std::array<int, 2>& end = faces_.segment(k).node;
    return near[end[0]] || near[end[1]];
  });
  const auto wanted = [&](int n, int k) { return faces_.body_of_segment(k) != faces_.outline().body[n]; };
  const double beyond = find_(faces_, nodes, segments, (reach + skin) * dp_, horizon * dp_, wanted, others_);
  others_bound_.restart(beyond - (reach + turn_slack) * dp_, {});
  near_wall_.clear();
  for (const int n : all_nodes_)
    for (int w = 0; w < walls.count(); ++w)
      if (walls.height(w, faces_.places()[n]) < 0.5 * horizon * dp_) near_wall_.emplace_back(n, w);
}

/// No segment beside the node will act on this one before the next search (facet_search.hpp:find). What
/// started within four spacings is of this contact only from when it has begun to face each other: so near
/// there are right angles in many a body, which would ask for a search every few steps.
template <int Dim>
bool FaceContacts<Dim>::looks_aside(int node, int segment) const {
  const auto& [a, b] = faces_.segment(segment).node;
  const V D = faces_.x0(node) - 0.5 * (faces_.x0(a) + faces_.x0(b));
  const double least = dot(D, D) < close_by * close_by * dp_ * dp_ ? folded : aside;
  return std::ranges::all_of(faces_.outline().beside[node], [&](int k) {
    return k == Outline::none || dot(normal_[k], normal_[segment]) >= least;
  });
}

template <int Dim>
void FaceContacts<Dim>::search_own(const Particles<Dim>& s) {
  normal_.clear();
  for (const int k : all_segments_) normal_.push_back(faces_.normal_of(k));
  const double least2 = far_apart * far_apart * dp_ * dp_;
  const auto wanted = [&](int n, int k) {
    if (faces_.body_of_segment(k) != faces_.outline().body[n]) return false;
    for (const int end : faces_.segment(k).node) {
      const V d = faces_.x0(n) - faces_.x0(end);
      if (dot(d, d) <= least2) return false;
    }
    return !looks_aside(n, k);
  };
  const double beyond =
      find_(faces_, all_nodes_, all_segments_, (reach + skin) * dp_, horizon * dp_, wanted, own_);
  faces_.follow(s, behind_);
  own_bound_.restart(beyond - (reach + turn_slack) * dp_, behind_);
}

/// Nodes that are listed or stand beside one, and their particles.
template <int Dim>
void FaceContacts<Dim>::watch() {
  std::vector<bool> seen(faces_.size());
  const auto with_neighbors = [&](int n) {
    for (const int k : faces_.outline().beside[n])
      if (k != Outline::none)
        for (const int end : faces_.segment(k).node) seen[end] = true;
  };
  for (const NearFaces* near : {&others_, &own_}) {
    for (const int n : near->node) with_neighbors(n);
    for (const int k : near->segment)
      for (const int end : faces_.segment(k).node) with_neighbors(end);
  }
  for (const auto& [n, wall] : near_wall_) with_neighbors(n);
  watched_.clear();
  touching_.clear();
  for (const int n : all_nodes_) {
    if (!seen[n]) continue;
    watched_.push_back(n);
    faces_.for_each_share(n, [&](int i, double) { touching_.push_back(i); });
  }
  std::sort(touching_.begin(), touching_.end());
  touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
  watch_segments();
}

template <int Dim>
void FaceContacts<Dim>::watch_segments() {
  std::vector<bool> watched(faces_.size());
  for (const int n : watched_) watched[n] = true;
  watched_segments_.clear();
  std::ranges::copy_if(all_segments_, std::back_inserter(watched_segments_), [&](int k) {
    const std::array<int, 2>& end = faces_.segment(k).node;
    return watched[end[0]] && watched[end[1]];
  });
}

template <int Dim>
void FaceContacts<Dim>::place_watched(const Particles<Dim>& s) {
  for (const int n : watched_) faces_.place(s, n);
  for (const int k : watched_segments_) faces_.set_normal(k);
}

/// f(node, foot, touch) of each listed node that faces something within `reach`, and of some beyond. Half and half of
/// two sides of a corner where the node is inside and as far from both: by one alone what is symmetric would be pushed
/// aside.
template <int Dim>
template <class F>
void FaceContacts<Dim>::for_each_touch(const NearFaces& near, const F& f) const {
  for (std::size_t k = 0; k < near.node.size(); ++k) {
    const int n = near.node[k];
    const auto segments = std::span(near.segment).subspan(near.begin[k], near.begin[k + 1] - near.begin[k]);
    Foot<Dim> foot, twin;
    const auto distance2 = [&](int l) { return faces_.distance2(n, l); };
    const int nearest = *std::ranges::min_element(segments, {}, distance2);
    const auto is_sharp = [&](int l) { return faces_.has_sharp_end(l); };  // may be met from beyond its end
    if (distance2(nearest) >= power<2>(reach * dp_) && std::ranges::none_of(segments, is_sharp)) continue;
    faces_.measure(n, nearest, foot);  // first: few others can be the foot then
    for (const int l : segments)
      if (l != nearest) faces_.measure(n, l, foot);
    if (foot.segment == Outline::none) continue;
    const auto touch = faces_.touch(foot);
    for (const int l : segments) {
      if (touch.depth <= 0 || !faces_.beside(l, foot.segment)) continue;
      Foot<Dim> other;
      faces_.measure(n, l, other);
      if (std::abs(other.rank - foot.rank) < tie * dp_) twin = other;
    }
    if (twin.segment == Outline::none) {
      f(n, foot, touch);
      continue;
    }
    for (Foot<Dim>* half : {&foot, &twin}) {
      half->weight = 0.5;
      f(n, *half, faces_.touch(*half));
    }
  }
}

/// f(node, wall, depth, area, k): its mirror image lies twice as deep behind it, and half of the energy of
/// the two is its own.
template <int Dim>
template <class F>
void FaceContacts<Dim>::for_each_wall(const WallContacts<Dim>& walls, const F& f) const {
  for (const auto& [n, wall] : near_wall_) {
    const double height = walls.height(wall, faces_.places()[n]);
    if (height >= 0) continue;
    const double area = faces_.facing(n, walls.normal(wall));
    if (area > 0) f(n, wall, -2 * height, area, surface_stiffness(M_[n], M_[n], stiffness_, dp_));
  }
}

template <int Dim>
void FaceContacts<Dim>::act_on_nodes(const Particles<Dim>& s, double dt, WallContacts<Dim>& walls) {
  for (const int n : watched_) own_force_[n] = reaction_[n] = V{};
  const auto push_back_to = [&](std::vector<V>& reaction) {
    return [&](int n, const Foot<Dim>& foot, const auto& touch) {
      if (touch.depth <= 0 || touch.depth >= reach * dp_) return;
      faces_.push(
          foot, touch, stiffness(n, foot.segment), [&](int node, const V& f) { own_force_[node] += f; },
          [&](int node, const V& f) { reaction[node] += f; });
    };
  };
  for_each_touch(others_, push_back_to(reaction_));
  for_each_touch(own_, push_back_to(own_force_));
  for_each_wall(walls, [&](int n, int wall, double depth, double area, double k) {
    // 2: of the pass over the node and of that over its image
    const auto give = [&](int node, const V& f) {
      own_force_[node] += f;
      faces_.for_each_share(
          node, [&](int i, double weight) { walls.book(s.x[i], (dt * s.mobile[i] * weight) * f); });
    };
    give(n, (2 * surface_force(depth, area, k)) * walls.normal(wall));
    faces_.push_facing(n, walls.normal(wall), surface_energy(depth, 1, k), give);
  });
}

template <int Dim>
void FaceContacts<Dim>::evaluate(const Particles<Dim>& s, double dt, WallContacts<Dim>& walls,
                                 std::vector<V>& force, int) {
  place_watched(s);
  act_on_nodes(s, dt, walls);
  for (const int i : touching_) force[i] = V{};
  for (const int n : watched_) {
    const V f = own_force_[n] + reaction_[n];
    faces_.for_each_share(n, [&](int i, double weight) { force[i] += weight * f; });
  }
}

template <int Dim>
double FaceContacts<Dim>::energy(const Particles<Dim>& s, const WallContacts<Dim>& walls) {
  place_watched(s);
  double sum = 0;
  for (const NearFaces* near : {&others_, &own_}) {
    for_each_touch(*near, [&](int n, const Foot<Dim>& foot, const auto& touch) {
      if (touch.depth < reach * dp_)
        sum += surface_energy(touch.depth, foot.area(), stiffness(n, foot.segment));
    });
  }
  for_each_wall(walls, [&](int, int, double depth, double area, double k) {
    sum += surface_energy(depth, area, k);  // both passes, half of them of the image
  });
  return sum;
}

template <int Dim>
auto FaceContacts<Dim>::between(int a, int b) const -> V {
  V sum{};
  for_each_touch(others_, [&](int n, const Foot<Dim>& foot, const auto& touch) {
    if (touch.depth <= 0 || touch.depth >= reach * dp_) return;
    const int own = faces_.outline().body[n], other = faces_.body_of_segment(foot.segment);
    V f{};
    faces_.push(
        foot, touch, stiffness(n, foot.segment), [&](int, const V& on_own) { f += on_own; },
        [](int, const V&) {});
    if (own == a && other == b) sum += f;
    if (own == b && other == a) sum -= f;
  });
  return sum;
}

template <int Dim>
auto FaceContacts<Dim>::of_wall(int a, int wall, const WallContacts<Dim>& walls) const -> V {
  double sum = 0;
  for_each_wall(walls, [&](int n, int met, double depth, double area, double k) {
    if (met == wall && faces_.outline().body[n] == a) sum += 2 * surface_force(depth, area, k);
  });
  return sum * walls.normal(wall);
}

template <int Dim>
double FaceContacts<Dim>::gap(const Particles<Dim>& s, int a, int b) {
  if (others_.node.empty()) return reach * dp_;
  place_watched(s);
  double least = reach * dp_;
  for_each_touch(others_, [&](int n, const Foot<Dim>& foot, const auto& touch) {
    if (touch.depth >= reach * dp_) return;
    const int own = faces_.outline().body[n], other = faces_.body_of_segment(foot.segment);
    if ((own == a && other == b) || (own == b && other == a)) least = std::min(least, -touch.depth);
  });
  return least;
}

template class FaceContacts<2>;

}  // namespace taut::inline TAUT_ISA
