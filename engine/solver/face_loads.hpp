#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// A traction on the face of a body, whose outermost particles stand half a spacing inside it. All of it on
/// that layer would act half a spacing too deep: a block under uniform traction had σ off by a third to a
/// half in the layer itself. What acts on the face is felt by the layers below it too, as the method takes
/// gradients from there.
///
/// The layer is that of the load's region. Its normals come from the layer alone, so that a corner belongs to
/// the face that is loaded; `traction` and the area that a particle stands for are those of the face, half a
/// spacing outside. Both take the layer to be one spacing thick: where those of a ring are not, the area, V0
/// over the spacing, is off by the ratio.
struct FaceLayer {
  std::vector<int> id;
  std::vector<Point> normal;    // outwards
  std::vector<Point> traction;  // Pa, where the ramp is 1
  std::vector<double> area;     // m^(dim − 1)
  bool has_edge = false;  // of a region that is no layer: some of it is, and looks two ways across each other
};

/// Of the particles `id` of the load's region; without any where they are no layer, of which each particle has
/// others on a line through it, or on a plane, and the rest of the body on one side.
FaceLayer face_layer(const Load& load, const InitialParticles& initial, std::vector<int> id, double spacing);

/// A share of a load, N.
using FaceShare = std::pair<int, Point>;

/// The shares of a traction t with S_j = Σ_k (V_k g_kj − V_j g_jk), the surface that belongs to particle j,
/// by id, under the method's own gradient Σ_k (f_k − f_j) g_jk: on a face about 1.5 dp, −0.5 dp and 0 in the
/// layers from the outermost one on, which is the force at the face whose displacement follows from theirs.
/// - uniform: f_j = t (n · S_j), the force that a uniform stress σ, σ n = t, takes at j. So a uniform stress is at
///   rest to round-off, corners and edges included. Force and moment are exact where t is uniform, the gradient exact
///   for linear fields and the face a whole side of a rectangle or box, not of curved faces or oblique corners. Of a t
///   that is linear along the face a corner moves the moment by the order of dp².
/// - by_column: the force of each particle of the layer is shared like n · S_j among those below it. At corners and
///   edges of the body the layer's areas have the end correction of the midpoint rule: the first three 1 + 5/96,
///   1 − 6/96 and 1 + 1/96 times theirs, in 3D across each edge. So the force of a t that is linear along the face is
///   exact, and where t is normal to a plane face its moment (−1 % without at ten rows, −0.15 % with); a corner is not
///   at rest. Where Σ n · S is less than half of the area the force stays on the layer.
/// Where a body is so thin that particles feel the opposite face too, S_j is of both faces: the half of the
/// column that is nearer counts, and what it lacks of the area (−1 times it in 2 rows, −0.5 in 3, next to
/// nothing from 6 on) acts at the middle, in both rules. The opposite face has the same there with the other
/// sign: a uniform stress stays at rest, and force and moment are those of the face.
enum class FaceRule : std::uint8_t { uniform, by_column };
/// `surface` by id; `reach` that of the gradient, m.
std::vector<FaceShare> face_shares(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                   double reach, const std::vector<Point>& surface, double spacing);

}  // namespace taut
