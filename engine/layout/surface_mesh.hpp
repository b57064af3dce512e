#pragma once

#include <array>
#include <vector>

#include "engine/layout/face_nodes.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// The faces of all bodies in 3D: quadrilaterals, each with a node at each corner.
struct SurfaceMesh : FaceNodes {
  struct Facet {
    std::array<int, 4> node{};  // against the clock, seen from outside
    int body = 0;
    int particle = 0;  // that it lies in front of
    double area = 0;   // at the start, m²: the length of its vector area
    double bulge = 0;  // of the face over the mean of the corners, along the normal, m
  };
  std::vector<Facet> facets;  // by body
  std::vector<bool> closed;   // [body] none is missing
};

/// ½ (x2 − x0) × (x3 − x1), m², of the corners of a facet: it points outwards.
Point vector_area(const std::array<Point, 4>& corner);

/// The patches of a body that a shape lays in layers (FacePatches). Of others a facet for each face of a cell of
/// the lattice that no other cell of the body shares, its corners brought to the nearest face of the shapes: so
/// steps at a curved face are laid smooth. That of a mirrored body is the
/// mirror image, in the same order, to the last bit. What lies in front of a body that is too thin to tell
/// where its faces are has none. Empty in 2D.
SurfaceMesh make_surface_mesh(const Scene& scene, const InitialParticles& initial, int threads = 1);

/// There is such a mesh: none of the bodies is made of particles that were given one by one.
bool can_have_surface_mesh(const Scene& scene);

}  // namespace taut
