#pragma once

#include <array>
#include <vector>

#include "engine/layout/face_nodes.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// The faces of all bodies in 2D: nodes, and straight segments with one at each end.
struct Outline : FaceNodes {
  static constexpr int none = -1;

  struct Segment {
    std::array<int, 2> node{};
    double length = 0;  // at the start, m
    double sense = 1;   // the outward normal is sense (t_y, −t_x), t from the first node to the second
  };

  std::vector<int> body;                   // [node]
  std::vector<std::array<int, 2>> beside;  // [node] the segment that ends there and the one that begins
  std::vector<Segment> segments;

  int body_of(const Segment& segment) const { return body[static_cast<std::size_t>(segment.node[0])]; }
};

/// That of a body is the one of the union of its shapes, less what is cut out: no segment lies inside another
/// shape. The nodes of a mirrored body are the mirror images, in the same order, to the last bit. Empty in 3D
/// (see surface_mesh.hpp), of a shape that has none, and where too few particles lie around a node.
Outline make_outline(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
