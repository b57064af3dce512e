#include "engine/contact/face_candidates.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "engine/contact/near_other_bodies.hpp"

namespace taut {

bool FaceCandidates::search(const Particles<2>& s, MovingFaces& faces, const WallContacts<2>& walls,
                            std::optional<double> way) {
  if (faces.size() == 0) return false;
  if (!way) faces.renumber(s);
  const bool others = meets_others_ && !(way && others_bound_.holds(*way));
  bool own = meets_itself_ && !(way && own_bound_.holds(*way));
  if (own && way) {
    faces.follow(s, main_places_);
    own = !own_bound_.still_holds(main_places_, faces.outline().body, *way);
  }
  if (!others && !own) return false;
  faces.place_all(s);
  if (others) search_others(faces, walls);
  if (own) search_own(s, faces);
  if (others && way) others_bound_.holds(*way);
  if (own && way) own_bound_.holds(*way);
  watch(faces);
  return true;
}

void FaceCandidates::search_others(const MovingFaces& faces, const WallContacts<2>& walls) {
  constexpr double margin = horizon + 2;  // 2: greatest length of a segment
  const std::vector<char> near = near_other_bodies<2>(faces.places(), faces.outline().body, margin * dp_);
  std::vector<int> nodes, segments;
  std::ranges::copy_if(all_nodes_, std::back_inserter(nodes), [&](int n) { return near[n]; });
  std::ranges::copy_if(all_segments_, std::back_inserter(segments), [&](int k) {
    const std::array<int, 2>& end = faces.segment(k).node;
    return near[end[0]] || near[end[1]];
  });
  const auto wanted = [&](int n, int k) { return faces.body_of_segment(k) != faces.outline().body[n]; };
  const double beyond =
      find_(faces, nodes, segments, (reach_ + skin) * dp_, horizon * dp_, wanted, other_faces);
  others_bound_.restart(beyond - (reach_ + turn_slack) * dp_, {});
  near_wall.clear();
  for (const int n : all_nodes_)
    for (int w = 0; w < walls.count(); ++w)
      if (walls.height(w, faces.places()[n]) < 0.5 * horizon * dp_) near_wall.emplace_back(n, w);
}

/// Whether no side of the node can face the segment before the next search. Initially close faces are often at right
/// angles; without `folded` they would make a search due every few steps.
bool FaceCandidates::cannot_face(const MovingFaces& faces, int node, int segment) const {
  const auto& [a, b] = faces.segment(segment).node;
  const V D = faces.x0(node) - 0.5 * (faces.x0(a) + faces.x0(b));
  const double least = dot(D, D) < close_by * close_by * dp_ * dp_ ? folded : aside;
  return std::ranges::all_of(faces.outline().beside[node], [&](int k) {
    return k == Outline::none || dot(normal_[k], normal_[segment]) >= least;
  });
}

void FaceCandidates::search_own(const Particles<2>& s, const MovingFaces& faces) {
  normal_.clear();
  for (const int k : all_segments_) normal_.push_back(faces.normal_of(k));
  const double least2 = far_apart * far_apart * dp_ * dp_;
  const auto wanted = [&](int n, int k) {
    if (faces.body_of_segment(k) != faces.outline().body[n]) return false;
    for (const int end : faces.segment(k).node) {
      const V d = faces.x0(n) - faces.x0(end);
      if (dot(d, d) <= least2) return false;
    }
    return !cannot_face(faces, n, k);
  };
  const double beyond =
      find_(faces, all_nodes_, all_segments_, (own_reach_ + skin) * dp_, horizon * dp_, wanted, own_faces);
  faces.follow(s, main_places_);
  own_bound_.restart(beyond - (own_reach_ + turn_slack) * dp_, main_places_);
}

void FaceCandidates::watch(const MovingFaces& faces) {
  std::vector<bool> seen(faces.size());
  const auto with_neighbors = [&](int n) {
    for (const int k : faces.outline().beside[n])
      if (k != Outline::none)
        for (const int end : faces.segment(k).node) seen[end] = true;
  };
  for (const NearFaces* near : {&other_faces, &own_faces}) {
    for (const int n : near->node) with_neighbors(n);
    for (const int k : near->segment)
      for (const int end : faces.segment(k).node) with_neighbors(end);
  }
  for (const auto& [n, wall] : near_wall) with_neighbors(n);
  watched_nodes.clear();
  particles.clear();
  for (const int n : all_nodes_) {
    if (!seen[n]) continue;
    watched_nodes.push_back(n);
    faces.for_each_share(n, [&](int i, double) { particles.push_back(i); });
  }
  std::sort(particles.begin(), particles.end());
  particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  watched_segments.clear();
  std::ranges::copy_if(all_segments_, std::back_inserter(watched_segments), [&](int k) {
    const std::array<int, 2>& end = faces.segment(k).node;
    return seen[end[0]] && seen[end[1]];
  });
}

}  // namespace taut
