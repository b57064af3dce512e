#pragma once

#include <algorithm>
#include <vector>

#include "engine/scene/scene.hpp"

namespace taut {

struct PointWeight {
  int particle;
  double weight;
};

/// Radius within which particles determine a point, m.
constexpr double reach_of_points(double support, double dp) { return std::max(support, 2 * dp); }

/// Weights by moving least squares, exact for linear fields:
///   w_k = W_k (1, d_k)·A⁻¹·(1, 0),  A = Σ W_k (1, d_k) ⊗ (1, d_k),  d_k = X_k − X.
/// `reach` in m. Empty if the particles are too few or collinear (3D: coplanar).
std::vector<PointWeight> material_point(const std::vector<Point>& x, int begin, int end, const Point& at,
                                        double reach, int dim);

/// Greatest step between linked particles, in spacings: spans the diagonal of a cell, but no slot.
inline constexpr double link_of_neighbors = 1.8;

/// Particles linked by steps up to `link`, m, to the particle nearest to `at`; ascending.
std::vector<int> linked_to_nearest(const std::vector<Point>& x, const std::vector<int>& some, const Point& at,
                                   double link);

/// Ignores particles beyond a slot.
std::vector<PointWeight> material_point(const std::vector<Point>& x, int begin, int end, const Point& at,
                                        double reach, const Scene& scene, int body);

struct Surroundings {
  const std::vector<Point>& x;  // m
  const std::vector<unsigned char>& clamped;
  const std::vector<unsigned char>& driven;
  const std::vector<int>& material;
  int begin, end;
  double reach;  // m
  double link;   // m; infinite = links all
  int dim;
};

/// If `point` mixes materials or contains clamped or driven particles, extrapolates from free particles of one
/// material instead, or driven ones if none is free. Empty if all are clamped.
std::vector<PointWeight> point_of_stress(std::vector<PointWeight> point, const Surroundings& all,
                                         const Point& at);

/// At kinks of the displacement, replaces `point` by weights of particles with the motion or the material of the
/// nearest particle. `motion_group[i]`: joint motion of particle i; 0 = free.
std::vector<PointWeight> point_of_motion(std::vector<PointWeight> point, const Surroundings& all,
                                         const std::vector<int>& motion_group, const Point& at);

}  // namespace taut
