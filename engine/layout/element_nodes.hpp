#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/layout/material_point.hpp"

namespace taut {

/// Nodes of finite elements as particles. A node has the summed mass of its elements' shares. Regions, such as clamps,
/// contain an element if they contain its middle, and a node with one of its elements; with Body::on_boundary they
/// contain nodes by their places. Where regions meet, clamps come first, then drives; later regions count. Throws
/// SceneError for bodies without mesh, jitter, empty regions, and overlapping bodies.
InitialParticles make_element_nodes(const Scene& scene);

/// Weight of each node of a body in a load: the volume in m^dim of its shares of loaded elements; for tractions its
/// share of the face in m^(dim − 1). The face is on that side of the loaded elements where most of them end.
std::vector<double> load_weights(const Load& load, const Body& body, const InitialParticles& initial,
                                 int index);

/// Shape functions at a point of a body, by node. Empty if no element contains the point.
std::vector<PointWeight> point_in_element(const InitialParticles& initial, int body, const Point& at);

}  // namespace taut
