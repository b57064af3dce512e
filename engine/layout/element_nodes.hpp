#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/layout/material_point.hpp"

namespace taut {

/// Nodes of finite elements as particles. A node has the summed mass of its elements' shares. A region, such as a clamp,
/// contains a cell between neighbouring nodes if it contains the middle of the cell, and with it the nodes of the cell;
/// with Body::on_boundary it contains nodes by their places. The material of an element is that of its middle. Where
/// regions meet, clamps come before drives, and later drives before earlier ones. Throws SceneError for bodies without
/// mesh, jitter, empty regions, and overlapping bodies.
InitialParticles make_element_nodes(const Scene& scene);

/// Weight of each node of a body in a load: the volume in m^dim of its shares of loaded cells; for tractions its share
/// of the face in m^(dim − 1). The face is on that side of the loaded cells where most of them end.
std::vector<double> load_weights(const Load& load, const Body& body, const InitialParticles& initial,
                                 int index);

/// Shape functions at a point of a body, by node. Empty if no element contains the point.
std::vector<PointWeight> point_in_element(const InitialParticles& initial, int body, const Point& at);

}  // namespace taut
