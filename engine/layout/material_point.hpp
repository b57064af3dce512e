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

/// The longest step of a chain of neighbours, in spacings: across the corner of a cell, not across a slot.
inline constexpr double link_of_neighbors = 1.8;

/// Those of `some` that a chain of steps of `link`, m, among them leads to from the one nearest to `at`, in rising order.
std::vector<int> linked_to_nearest(const std::vector<Point>& x, const std::vector<int>& some, const Point& at,
                                   double link);

/// The same of a point of this body, without those that no chain of neighbours leads to from the nearest one: beyond a
/// slot. Where its particles stand on its faces (Body::on_boundary) the point is
/// in a cell between some of them and counts these only, linearly along each edge: on a particle it is that
/// particle, so that what is held there is seen to be.
std::vector<PointWeight> material_point(const std::vector<Point>& x, int begin, int end, const Point& at,
                                        double reach, const Scene& scene, int body);

/// The particles of a body, among which a point of it is looked for.
struct Surroundings {
  const std::vector<Point>& x;  // m
  const std::vector<unsigned char>& held;
  const std::vector<unsigned char>& driven;
  const std::vector<int>& material;
  int begin, end;
  double reach;  // m
  double link;   // m: a particle counts that a chain of such steps leads to; infinite: any
  int dim;
};

/// What is held or driven has no stress of its own in most methods, and across an interface stresses jump: `point`,
/// which may have some of either, or instead a point of the free particles of the material that the nearest of them has,
/// whose stress goes on linearly to `at`. Where these are too few for a slope it is the nearest one. Amid driven ones
/// only, which may be let go, it is a point of those; empty where all are held.
std::vector<PointWeight> point_of_stress(std::vector<PointWeight> point, const Surroundings& all,
                                         const Point& at);

/// What is held or driven moves as a whole, with a kink before it, and displacements have one at an interface: `point`,
/// or, where the nearest particle is held or driven, a point of those alone that move with it, of which one is enough;
/// beside an interface a point of those of the nearest one's material. `moves_with[i]` is one number for all that do; 0
/// for what is free.
std::vector<PointWeight> point_of_motion(std::vector<PointWeight> point, const Surroundings& all,
                                         const std::vector<int>& moves_with, const Point& at);

}  // namespace taut
