#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/layout/material_point.hpp"

namespace taut {

/// Nodes of finite elements as particles. The mass of a node is the sum of its shares of the adjacent elements.
/// A region, such as a clamp, contains all nodes of each cell (part of an element between neighbouring nodes) whose
/// middle is in it. With Body::on_boundary it contains the nodes that lie in it. The material of an element is the
/// material at its middle. Where regions meet, clamps come before drives, and later drives before earlier ones. Throws
/// SceneError for bodies without mesh, jitter, empty regions, elements both clamped and driven, and overlapping bodies.
InitialParticles make_element_nodes(const Scene& scene);

/// Weight of each node of a body in a load: its volume share of the loaded cells, m^dim (with Body::on_boundary: the
/// volumes of the nodes in the region); for tractions its share of the face in m^(dim − 1). The face is the local side
/// of elements with the most boundary facets of loaded cells.
std::vector<double> load_weights(const Load& load, const Body& body, const InitialParticles& initial,
                                 int index);

/// Shape functions at a point of a body, by node. Empty if no element contains the point.
std::vector<PointWeight> point_in_element(const InitialParticles& initial, int body, const Point& at);

}  // namespace taut
