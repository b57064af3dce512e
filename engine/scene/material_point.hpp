#pragma once

#include <algorithm>
#include <vector>

#include "engine/scene/scene.hpp"

namespace taut {

/// A particle's share in a material point.
struct PointWeight {
  int particle;
  double weight;
};

/// Reach of those that tell of a point, m: of the particles that act on each other, at least two spacings,
/// since beyond a face or a corner fewer lie on a line.
constexpr double reach_of_points(double support, double dp) { return std::max(support, 2 * dp); }

/// A material point as a mean of the particles around it, with weights of moving least squares,
///   w_k = W_k (1, d_k)·A⁻¹·(1, 0),  A = Σ W_k (1, d_k) ⊗ (1, d_k),  d_k = X_k − X,
/// so that a point on a face, half a spacing outside the outermost particles, is exact for a linear field.
/// `x` are initial positions, of which those from `begin` to before `end` and nearer than `reach` count, m.
/// Empty where they are too few or lie on a line.
std::vector<PointWeight> material_point(const std::vector<Point>& x, int begin, int end, const Point& at,
                                        double reach, int dim);

/// The same of a point of this body. Where its particles stand on its faces (Body::on_boundary) the point is
/// in a cell between some of them and counts these only, linearly along each edge: on a particle it is that
/// particle, so that what is held there is seen to be.
std::vector<PointWeight> material_point(const std::vector<Point>& x, int begin, int end, const Point& at,
                                        double reach, const Scene& scene, int body);

/// Those of the particles from `begin` to before `end` that are not held.
struct FreeParticles {
  std::vector<int> id;
  std::vector<Point> x;  // m

  FreeParticles(const std::vector<Point>& all, const std::vector<unsigned char>& held, int begin, int end);
};

/// What is held has no stress of its own in most methods: `point`, which may have some of it, or instead a point of
/// the free particles, whose stress goes on linearly to `at`; empty where these are too few.
std::vector<PointWeight> point_of_stress(std::vector<PointWeight> point,
                                         const std::vector<unsigned char>& held, const FreeParticles& free,
                                         const Point& at, double reach, int dim);

}  // namespace taut
