#pragma once

#include <vector>

#include "engine/scene/scene.hpp"

namespace taut {

/// Finite elements of all bodies, body after body. Local nodes are numbered along axis 0 first.
struct ElementMesh {
  int dim = 2, order = 0;           // order 0: no elements
  std::vector<Point> x;             // [node] reference position, m
  std::vector<int> node;            // [element][local node]
  std::vector<Point> middle;        // [element] mean of the corners, m
  std::vector<double> volume;       // [element][local node] share of the node, m^dim
  std::vector<int> body, material;  // [element]

  int nodes_of_each() const {
    return dim == 2 ? (order + 1) * (order + 1) : (order + 1) * (order + 1) * (order + 1);
  }
  int size() const { return static_cast<int>(middle.size()); }
};

/// Piece of a face between neighbouring nodes.
struct MeshFacet {
  // seen from outside, 2D: left node first; 3D: anticlockwise; reversed if `inverted`
  std::array<int, 4> node{};
  int element = 0;
  int side = 0;           // 2 axis + (1 at the upper end)
  bool inverted = false;  // the element is a mirror image of the reference element
};

/// Meshes a body with nodes about dp apart, numbered from 0. Throws SceneError for shapes without a mesh.
ElementMesh mesh_of_body(const Body& body, int dim, int order, double dp);

std::vector<MeshFacet> boundary_of(const ElementMesh& mesh);

}  // namespace taut
