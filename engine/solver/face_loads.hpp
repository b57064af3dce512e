#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Particles below a loaded face of a body: its outermost layer, half a spacing inside the face. A traction that
/// acted on this layer alone would act half a spacing too deep.
/// Normals are computed from the layer alone, so that a corner belongs to the loaded face. `traction` and `area`
/// refer to the face. The area, V0 over the spacing, assumes a layer of one spacing; for thicker or thinner layers
/// of rings it is off by the ratio.
struct FaceLayer {
  std::vector<int> id;
  std::vector<Point> normal;    // unit vectors, outwards
  std::vector<Point> traction;  // Pa, at ramp factor 1
  std::vector<double> area;     // m^(dim − 1)
  bool has_edge = false;        // the region is not a layer, since it covers two faces that meet
};

/// Layer of the particles `id` in the region of `load`. Returns an empty layer unless each particle and its
/// neighbours in the region lie on a line (3D: a plane) and the rest of the body is on one side.
FaceLayer face_layer(const Load& load, const InitialParticles& initial, std::vector<int> id, double spacing);

/// Particle id and force, N.
using FaceShare = std::pair<int, Point>;

/// Rules that distribute a traction t over the particles near a face. Both use S_j = Σ_k (V_k g_kj − V_j g_jk), the
/// surface of particle j under the gradient Σ_k (f_k − f_j) g_jk of the method. On a face, S_j is about 1.5, −0.5
/// and 0 dp in the layers from outside.
/// - uniform: f_j = t (n · S_j). A uniform stress σ with σ n = t is in equilibrium to round-off, also at corners.
///   Force and moment are exact only for uniform t on a whole side of a rectangle or box.
/// - by_column: the particles below a layer particle share its force in proportion to n · S_j. The areas have the
///   end correction of the midpoint rule, so that the force of a linear t is exact, and its moment too if t is
///   normal to a plane face. Corners are not in equilibrium. If Σ n · S is below half of the area, the whole force
///   stays on the layer.
/// In thin bodies, S_j includes the opposite face. Both rules then use the half of the column nearer to the face
/// and apply the missing area at the middle. The opposite face applies the same area there with the opposite sign.
enum class FaceRule : std::uint8_t { uniform, by_column };
/// Force on each particle, in N. `surface`: S by id, m^(dim − 1); `reach`: range of the gradient, m.
std::vector<FaceShare> face_shares(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                   double reach, const std::vector<Point>& surface, double spacing);

}  // namespace taut
