#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Outermost layer below a loaded face, half a spacing inside. A traction on this layer alone would act half a
/// spacing too deep. `traction` and `area` refer to the face. The area assumes a layer of one spacing.
struct FaceLayer {
  std::vector<int> id;
  std::vector<Point> normal;    // outwards
  std::vector<Point> traction;  // Pa, at ramp factor 1
  std::vector<double> area;     // m^(dim − 1)
  bool has_edge = false;        // the region covers two faces that meet
};

/// Empty unless each particle and its neighbours in the region lie on a line (3D: a plane) with the rest of the body
/// on one side.
FaceLayer face_layer(const Load& load, const InitialParticles& initial, std::vector<int> id, double spacing);

/// Id and N.
using FaceShare = std::pair<int, Point>;

/// Rules that distribute a traction t over the particles near a face. Both use S_j = Σ_k (V_k g_kj − V_j g_jk), the
/// surface of particle j under the gradient Σ_k (f_k − f_j) g_jk of the method.
/// - uniform: f_j = t (n · S_j). A uniform stress σ with σ n = t is in equilibrium to round-off, also at corners.
/// Force and moment are exact only for uniform t on a whole side of a rectangle or box.
/// - by_column: the particles below a layer particle share its force in proportion to n · S_j. Force and moment of a
/// linear t are exact, the moment if t is normal to a plane face. Corners are not in equilibrium. If Σ n · S is
/// below half of the area, the whole force stays on the layer.
/// In thin bodies, S_j includes the opposite face. Both rules then use the half of the column nearer to the face and
/// apply the missing area at the middle, as does the opposite face with the opposite sign.
enum class FaceRule : std::uint8_t { uniform, by_column };
/// N. `surface`: S by id, m^(dim − 1); `reach`: of the gradient, m.
std::vector<FaceShare> face_shares(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                   double reach, const std::vector<Point>& surface, double spacing);

}  // namespace taut
