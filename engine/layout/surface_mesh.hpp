#pragma once

#include <array>
#include <vector>

#include "engine/layout/face_nodes.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

struct SurfaceMesh : FaceNodes {
  struct Facet {
    std::array<int, 4> node{};  // anticlockwise, seen from outside
    int body = 0;
    int particle = 0;
    double area = 0;   // in the reference configuration, m²
    double bulge = 0;  // height of the face over the mean of the corners, positive outwards, m
  };
  std::vector<Facet> facets;  // by body
  std::vector<bool> closed;   // [body] no node is missing
};

/// ½ (x2 − x0) × (x3 − x1), outwards, m².
Point vector_area(const std::array<Point, 4>& corner);

/// Facets are patches of layered shapes, or outer sides of lattice cells, moved to the faces of the shapes. Omits
/// facets where a body is too thin. Empty in 2D.
SurfaceMesh make_surface_mesh(const Scene& scene, const InitialParticles& initial, int threads = 1);

/// Returns false if a body has particles listed one by one.
bool can_have_surface_mesh(const Scene& scene);

}  // namespace taut
