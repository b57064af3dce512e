#pragma once

#include <array>
#include <map>
#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/layout/material_point.hpp"

namespace taut {

struct FaceNodes {
  std::vector<Point> x;             // [node] reference position on the face, m
  std::vector<int> begin{0};        // [node] index of its first share; then the number of shares
  std::vector<PointWeight> shares;  // x = Σ weight x_particle, exact for linear fields

  int size() const { return static_cast<int>(x.size()); }
  void add(const Point& at, const std::vector<PointWeight>& of) {
    x.push_back(at);
    shares.insert(shares.end(), of.begin(), of.end());
    begin.push_back(static_cast<int>(shares.size()));
  }
};

class NodeWeights {
 public:
  NodeWeights(const InitialParticles& initial, int body, double dp);

  /// Empty if too few particles are near or if they are coplanar (2D: collinear).
  std::vector<PointWeight> shares_of(const Point& x) const;

 private:
  using Cell = std::array<long, 3>;
  Cell cell_of(const Point& x) const;
  std::vector<int> near(const Point& x) const;

  const InitialParticles& initial_;
  double dp_;  // m
  std::map<Cell, std::vector<int>> cells_;
};

}  // namespace taut
