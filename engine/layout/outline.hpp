#pragma once

#include <array>
#include <vector>

#include "engine/layout/face_nodes.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

struct Outline : FaceNodes {
  static constexpr int none = -1;

  struct Segment {
    std::array<int, 2> node{};
    double length = 0;  // in the reference configuration, m
    double sense = 1;   // ±1; outward normal: sense (t_y, −t_x), t from first to second node
  };

  std::vector<int> body;                   // [node]
  std::vector<std::array<int, 2>> beside;  // [node] segments that end and begin there
  std::vector<Segment> segments;
  std::vector<bool> closed;  // [body] no part is too thin to have faces, except tips

  int body_of(const Segment& segment) const { return body[static_cast<std::size_t>(segment.node[0])]; }
};

/// Outlines each body's shapes minus cut-outs. Empty in 3D and for shapes without outline. Omits nodes with too few
/// particles nearby.
Outline make_outline(const Scene& scene, const InitialParticles& initial);

}  // namespace taut
