#include "engine/contact/particles_at_faces.hpp"

#include <algorithm>

#include "engine/layout/outline.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {
namespace {

std::vector<int> without_all_nearest(const InitialParticles& initial, double spacing) {
  constexpr double reach = 1.8;  // in spacings, between √3 and 2
  constexpr std::size_t all = 26;
  const auto near = initial_neighbors(initial, reach * spacing);
  std::vector<int> ids;
  for (int i = 0; i < initial.size(); ++i)
    if (near[i].size() < all) ids.push_back(i);
  return ids;
}

}  // namespace

std::vector<int> particles_at_faces(const Scene& scene, const InitialParticles& initial) {
  std::vector<int> ids;
  if (initial.mesh.order > 0) {
    for (const MeshFacet& facet : boundary_of(initial.mesh))
      ids.insert(ids.end(), facet.node.begin(), facet.node.end());
  } else {
    if (scene.dim == 3) return without_all_nearest(initial, scene.spacing);
    for (const PointWeight& share : make_outline(scene, initial).shares) ids.push_back(share.particle);
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace taut
