#include "engine/contact/face_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/core.h>

#include "engine/error.hpp"
#include "engine/layout/outline.hpp"

namespace taut {

namespace {

/// Mean K + 4G/3 of the particles of a node, Pa.
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

FaceContacts::FaceContacts(const SolverInput& input)
    : dp_(input.constants.dp),
      stiffness_(input.constants.contact_stiffness),
      has_mesh_(!input.initial.mesh.node.empty()),
      faces_(make_outline(input.scene, input.initial)),
      candidates_(input, faces_, reach, has_mesh_ ? own_reach : reach) {
  if (input.scene.bodies.size() > 1 || !input.scene.walls.empty()) refuse_thin(input.scene);
  const Outline& outline = faces_.outline();
  for (int n = 0; n < outline.size(); ++n) M_.push_back(modulus(outline, n, input));
  own_force_.resize(outline.size());
  reaction_.resize(outline.size());
}

void FaceContacts::refuse_thin(const Scene& scene) const {
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
    if (faces_.outline().closed[b]) continue;
    throw SceneError(
        "body." + scene.bodies[b].name,
        fmt::format("the contact law 'surface' needs faces, and body '{}' is too thin to have all of them: "
                    "use a smaller spacing or another law",
                    scene.bodies[b].name));
  }
}

bool FaceContacts::search(const Particles<2>& s, const WallContacts<2>& walls, std::optional<double> way) {
  const bool searched = candidates_.search(s, faces_, walls, way);
  if (searched) touching_ = candidates_.particles;
  return searched;
}

void FaceContacts::place_watched(const Particles<2>& s) {
  for (const int n : candidates_.watched_nodes) faces_.place(s, n);
  for (const int k : candidates_.watched_segments) faces_.set_normal(k);
}

/// Calls f(node, closest point, touch) at least for nodes that face a segment within `greatest_depth`. If both sides of
/// a corner are equally near, each counts half.
template <class F>
void FaceContacts::for_each_touch(const NearFaces& near, const F& f) const {
  std::vector<double> distance2;  // [segment] m²
  for (std::size_t k = 0; k < near.node.size(); ++k) {
    const int n = near.node[k];
    const auto segments = std::span(near.segment).subspan(near.begin[k], near.begin[k + 1] - near.begin[k]);
    ClosestPoint closest, twin;
    distance2.clear();
    for (const int l : segments) distance2.push_back(faces_.distance2(n, l));
    const auto nearest = std::ranges::min_element(distance2) - distance2.begin();
    // a node beyond a sharp end may touch
    const auto is_sharp = [&](int l) { return faces_.has_sharp_end(l); };
    if (distance2[nearest] >= power<2>(greatest_depth(near)) && std::ranges::none_of(segments, is_sharp))
      continue;
    faces_.measure(n, segments[nearest], closest);
    for (std::ptrdiff_t l = 0; l < std::ssize(segments); ++l)
      if (l != nearest && (distance2[l] < closest.rank * closest.rank || is_sharp(segments[l])))
        faces_.measure(n, segments[l], closest);
    if (closest.segment == Outline::none) continue;
    const auto touch = faces_.touch(closest, fades(near));
    for (const int l : segments) {
      if (touch.depth <= 0 || !faces_.beside(l, closest.segment)) continue;
      ClosestPoint other;
      faces_.measure(n, l, other);
      if (std::abs(other.rank - closest.rank) < tie * dp_) twin = other;
    }
    if (twin.segment == Outline::none) {
      f(n, closest, touch);
      continue;
    }
    for (ClosestPoint* half : {&closest, &twin}) {
      half->weight = 0.5;
      f(n, *half, faces_.touch(*half, fades(near)));
    }
  }
}

/// Calls f(node, wall, depth, area, k) for nodes that are behind a wall and face it. `depth`: overlap with the mirror
/// image, m.
template <class F>
void FaceContacts::for_each_wall(const WallContacts<2>& walls, const F& f) const {
  for (const auto& [n, wall] : candidates_.near_wall) {
    const double height = walls.height(wall, faces_.places()[n]);
    if (height >= 0) continue;
    const double area = faces_.facing(n, walls.normal(wall));
    if (area > 0) f(n, wall, -2 * height, area, surface_stiffness(M_[n], M_[n], stiffness_, dp_));
  }
}

void FaceContacts::act_on_nodes(const Particles<2>& s, double dt, WallContacts<2>& walls) {
  for (const int n : candidates_.watched_nodes) own_force_[n] = reaction_[n] = V{};
  const auto push = [&](const NearFaces& near, std::vector<V>& reaction) {
    for_each_touch(near, [&](int n, const ClosestPoint& closest, const auto& touch) {
      if (touch.depth <= 0 || touch.depth >= greatest_depth(near)) return;
      faces_.push(
          closest, touch, stiffness(n, closest.segment), faded(near),
          [&](int node, const V& f) { own_force_[node] += f; },
          [&](int node, const V& f) { reaction[node] += f; });
    });
  };
  push(candidates_.other_faces, reaction_);
  push(candidates_.own_faces, own_force_);
  for_each_wall(walls, [&](int n, int wall, double depth, double area, double k) {
    // 2: the node touches its image, and the image the node
    const auto give = [&](int node, const V& f) {
      own_force_[node] += f;
      faces_.for_each_share(
          node, [&](int i, double weight) { walls.record_impulse(s.x[i], (dt * s.mobile[i] * weight) * f); });
    };
    give(n, (2 * surface_force(depth, area, k)) * walls.normal(wall));
    faces_.push_facing(n, walls.normal(wall), surface_energy(depth, 1, k), give);
  });
}

void FaceContacts::evaluate(const Particles<2>& s, double dt, WallContacts<2>& walls, std::vector<V>& force,
                            int) {
  place_watched(s);
  act_on_nodes(s, dt, walls);
  for (const int i : touching_) force[i] = V{};
  for (const int n : candidates_.watched_nodes) {
    const V f = own_force_[n] + reaction_[n];
    faces_.for_each_share(n, [&](int i, double weight) { force[i] += weight * f; });
  }
}

double FaceContacts::energy(const Particles<2>& s, const WallContacts<2>& walls) {
  place_watched(s);
  double sum = 0;
  for (const NearFaces* near : {&candidates_.other_faces, &candidates_.own_faces}) {
    for_each_touch(*near, [&](int n, const ClosestPoint& closest, const auto& touch) {
      if (touch.depth < greatest_depth(*near))
        sum += faces_.energy(closest, touch, stiffness(n, closest.segment), faded(*near));
    });
  }
  for_each_wall(walls, [&](int, int, double depth, double area, double k) {
    sum += surface_energy(depth, area, k);  // half of the energy belongs to the image
  });
  return sum;
}

auto FaceContacts::between(const Particles<2>&, int a, int b) const -> V {
  V sum{};
  for_each_touch(candidates_.other_faces, [&](int n, const ClosestPoint& closest, const auto& touch) {
    if (touch.depth <= 0 || touch.depth >= reach * dp_) return;
    const int own = faces_.outline().body[n], other = faces_.body_of_segment(closest.segment);
    V f{};
    faces_.push(
        closest, touch, stiffness(n, closest.segment), faded(candidates_.other_faces),
        [&](int, const V& on_own) { f += on_own; }, [](int, const V&) {});
    if (own == a && other == b) sum += f;
    if (own == b && other == a) sum -= f;
  });
  return sum;
}

auto FaceContacts::of_wall(const Particles<2>&, int a, int wall, const WallContacts<2>& walls) const -> V {
  double sum = 0;
  for_each_wall(walls, [&](int n, int touched, double depth, double area, double k) {
    if (touched == wall && faces_.outline().body[n] == a) sum += 2 * surface_force(depth, area, k);
  });
  return sum * walls.normal(wall);
}

double FaceContacts::gap(const Particles<2>& s, int a, int b) {
  if (candidates_.other_faces.node.empty()) return reach * dp_;
  place_watched(s);
  double least = reach * dp_;
  for_each_touch(candidates_.other_faces, [&](int n, const ClosestPoint& closest, const auto& touch) {
    if (touch.depth >= reach * dp_) return;
    const int own = faces_.outline().body[n], other = faces_.body_of_segment(closest.segment);
    if ((own == a && other == b) || (own == b && other == a)) least = std::min(least, -touch.depth);
  });
  return least;
}

}  // namespace taut
