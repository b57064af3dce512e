#pragma once

#include <array>
#include <vector>

#include "engine/layout/face_nodes.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// Faces of all bodies in 3D.
struct SurfaceMesh : FaceNodes {
  struct Facet {
    std::array<int, 4> node{};  // anticlockwise, seen from outside
    int body = 0;
    int particle = 0;
    double area = 0;   // m²
    double bulge = 0;  // outwards, over the mean of the corners, m
  };
  std::vector<Facet> facets;  // by body
  std::vector<bool> closed;   // [body] no node is missing
};

/// ½ (x2 − x0) × (x3 − x1), m², outwards.
Point vector_area(const std::array<Point, 4>& corner);

/// Takes the patches of layered shapes, or the faces of lattice cells without a neighbour, with corners moved to the
/// nearest face. Mirrored bodies have exact mirror images. Omits facets where a body is too thin. Empty in 2D.
SurfaceMesh make_surface_mesh(const Scene& scene, const InitialParticles& initial, int threads = 1);

/// False if a body has particles listed one by one.
bool can_have_surface_mesh(const Scene& scene);

}  // namespace taut
