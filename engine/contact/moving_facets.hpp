#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/archive.hpp"
#include "engine/core/parallel.hpp"
#include "engine/layout/surface_mesh.hpp"
#include "engine/solver/particles.hpp"

namespace taut {

inline std::vector<int> indices_of(const std::vector<char>& seen) {
  std::vector<int> indices;
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (seen[k]) indices.push_back(static_cast<int>(k));
  return indices;
}

/// The midpoint of a facet is the mean of its nodes plus the bulge along the normal.
class MovingFacets {
 public:
  using V = Vec<double, 3>;

  struct Place {
    V middle{}, normal{};  // m; outward unit vector
    double area = 0;       // m²
  };
  /// Derivatives of an energy: N, N m, N/m.
  struct Slope {
    V middle{}, normal{};
    double area = 0;
  };

  MovingFacets() = default;
  explicit MovingFacets(SurfaceMesh mesh) : mesh_(std::move(mesh)), place_(mesh_.facets.size()) {
    for (const Point& x : mesh_.x) x_.push_back({x[0], x[1], x[2]});
    for (int facet = 0; facet < size(); ++facet) place(facet);
  }

  const SurfaceMesh& mesh() const { return mesh_; }
  int size() const { return static_cast<int>(mesh_.facets.size()); }
  int body(int facet) const { return mesh_.facets[facet].body; }
  std::vector<int> nodes_of(const std::vector<int>& facets) const {
    std::vector<char> seen(mesh_.size());
    for (const int facet : facets)
      for (const int node : mesh_.facets[facet].node) seen[node] = true;
    return indices_of(seen);
  }
  std::vector<int> particles_of(const std::vector<int>& nodes) const {
    std::vector<char> seen(stored_.empty() ? 0 : 1 + *std::ranges::max_element(stored_));
    for (const int node : nodes) for_each_share(node, [&](int i, double) { seen[i] = true; });
    return indices_of(seen);
  }

  /// Call after reordering particles.
  void renumber(const Particles<3>& s) {
    const std::vector<int> where = s.places_of_ids();
    stored_.clear();
    for (const PointWeight& share : mesh_.shares) stored_.push_back(where[share.particle]);
    particle_of_facet_.clear();
    for (const SurfaceMesh::Facet& facet : mesh_.facets) particle_of_facet_.push_back(where[facet.particle]);
  }

  /// Position of the particle behind each facet, m.
  void follow(const Particles<3>& s, std::vector<V>& x) const {
    x.clear();
    for (const int i : particle_of_facet_) x.push_back(s.x[i]);
  }

  void place(const Particles<3>& s, const std::vector<int>& nodes, const std::vector<int>& facets,
             int threads) {
    parallel_for(static_cast<int>(nodes.size()), threads, [&](int k) {
      V x{};
      for_each_share(nodes[k], [&](int i, double weight) { x += weight * s.x[i]; });
      x_[nodes[k]] = x;
    });
    parallel_for(static_cast<int>(facets.size()), threads, [&](int k) { place(facets[k]); });
  }
  const Place& operator[](int facet) const { return place_[facet]; }

  template <class F>
  void for_each_share(int node, const F& f) const {
    for (int k = mesh_.begin[node]; k < mesh_.begin[node + 1]; ++k) f(stored_[k], mesh_.shares[k].weight);
  }

  void push(int facet, const Slope& slope, std::vector<V>& force) const {
    const Place& place = place_[facet];
    const auto& n = mesh_.facets[facet].node;
    const V quarter = 0.25 * slope.middle;
    for (const int node : n) force[node] -= quarter;
    if (!(place.area > 0)) return;
    const V turn = slope.normal + mesh_.facets[facet].bulge * slope.middle;
    const V along = turn - dot(turn, place.normal) * place.normal;
    // half the derivative by the area vector
    const V half = 0.5 * ((1 / place.area) * along + slope.area * place.normal);
    const V first = cross(x_[n[3]] - x_[n[1]], half), second = cross(half, x_[n[2]] - x_[n[0]]);
    force[n[0]] += first, force[n[2]] -= first;
    force[n[1]] += second, force[n[3]] -= second;
  }

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    archive.fixed(stored_, particle_of_facet_);
    for (const std::vector<int>* list : {&stored_, &particle_of_facet_})
      archive.check("a particle of a face", [&] {
        return std::ranges::all_of(*list, [&](int i) { return is_below(i, particles); });
      });
  }

 private:
  void place(int facet) {
    const auto& n = mesh_.facets[facet].node;
    const V area = 0.5 * cross(x_[n[2]] - x_[n[0]], x_[n[3]] - x_[n[1]]);
    Place& place = place_[facet];
    place.middle = 0.25 * ((x_[n[0]] + x_[n[2]]) + (x_[n[1]] + x_[n[3]]));
    place.area = std::sqrt(dot(area, area));
    place.normal = place.area > 0 ? (1 / place.area) * area : V{};
    place.middle += mesh_.facets[facet].bulge * place.normal;
  }

  SurfaceMesh mesh_;
  std::vector<int> stored_;             // [share] storage index
  std::vector<int> particle_of_facet_;  // [facet] storage index
  std::vector<V> x_;                    // [node] m
  std::vector<Place> place_;
};

}  // namespace taut
