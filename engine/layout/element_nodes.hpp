#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/layout/material_point.hpp"

namespace taut {

/// A region contains all nodes of each cell (part of an element between neighbouring nodes) whose middle is in it; with
/// Body::on_boundary, the nodes in it. An element has the material at its middle. Throws SceneError for bodies without
/// mesh, jitter, empty regions, elements both clamped and driven, and overlapping bodies.
InitialParticles make_element_nodes(const Scene& scene);

/// Weight of each node in a load: its loaded volume, m^dim; for tractions its share of the face, m^(dim − 1). A
/// traction acts on the face, or the two opposite faces, behind which the region is one layer deep. In parts of a body
/// one layer thick, half of it acts on each side. Throws SceneError for deeper regions and for regions around an edge.
std::vector<double> load_weights(const Load& load, const Scene& scene, const InitialParticles& initial,
                                 int index);

/// Share of each held node in a region: the fraction of its fully held cells whose middle is in the region. Without
/// such cells, 1 if the node is in the region.
std::vector<double> shares_in_region(const Expression& where, const InitialParticles& initial,
                                     const std::vector<unsigned char>& held);

/// Shape functions at a point, by node. Empty outside all elements.
std::vector<PointWeight> point_in_element(const InitialParticles& initial, int body, const Point& at);

}  // namespace taut
