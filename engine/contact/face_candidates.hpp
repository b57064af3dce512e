#pragma once

#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "engine/contact/face_search.hpp"
#include "engine/contact/motion_bound.hpp"
#include "engine/contact/moving_faces.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// Contact candidates in 2D: nodes near segments and nodes near walls.
class FaceCandidates {
 public:
  using V = Vec<double, 2>;

  FaceCandidates(const SolverInput& input, const MovingFaces& faces, double reach, double own_reach)
      : dp_(input.constants.dp),
        reach_(reach),
        own_reach_(own_reach),
        meets_itself_(input.keeps_neighbors),
        meets_others_(input.scene.bodies.size() > 1 || !input.scene.walls.empty()),
        all_nodes_(faces.size()),
        all_segments_(faces.outline().segments.size()) {
    std::iota(all_nodes_.begin(), all_nodes_.end(), 0);
    std::iota(all_segments_.begin(), all_segments_.end(), 0);
  }

  NearFaces other_faces, own_faces;
  std::vector<std::pair<int, int>> near_wall;        // (node, wall)
  std::vector<int> watched_nodes, watched_segments;  // to place in each step, ascending
  std::vector<int> particles;                        // of the watched nodes, ascending

  bool search(const Particles<2>& s, MovingFaces& faces, const WallContacts<2>& walls,
              std::optional<double> way);

  template <class Archive>
  void serialize(Archive& archive, const MovingFaces& faces, int walls) {
    for (NearFaces* near : {&other_faces, &own_faces})
      near->serialize(archive, all_nodes_.size(), all_segments_.size());
    archive.indices(near_wall, std::pair(faces.size(), walls));
    archive(others_bound_, own_bound_);
    if constexpr (Archive::loads) watch(faces);
  }

 private:
  // lengths in spacings
  static constexpr double skin = 1;
  static constexpr double horizon = 4;    // search range
  static constexpr double far_apart = 3;  // least initial distance in one body
  static constexpr double aside = 0.5;    // greatest cosine of the normals of a candidate
  static constexpr double close_by = 4;   // initial distance; closer faces need a cosine below `folded`
  static constexpr double folded = -0.1;
  static constexpr double turn_slack = 0.5;  // for rotation of nodes about their particles

  void search_others(const MovingFaces& faces, const WallContacts<2>& walls);
  void search_own(const Particles<2>& s, const MovingFaces& faces);
  bool cannot_face(const MovingFaces& faces, int node, int segment) const;
  void watch(const MovingFaces& faces);

  double dp_;                 // m
  double reach_, own_reach_;  // range of contact of two bodies, of one body; spacings
  bool meets_itself_, meets_others_;
  std::vector<int> all_nodes_, all_segments_;
  FaceSearch find_;
  std::vector<V> normal_;
  MotionBound<2> others_bound_, own_bound_;
  std::vector<V> main_places_;  // [node] position of the main particle, m
};

}  // namespace taut
