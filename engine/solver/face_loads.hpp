#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Particles of a load's region that form the outermost layer of a face, half a spacing inside. A traction on this
/// layer alone would act too deep. Normals follow from the layer only, so that a corner belongs to the loaded face.
/// The layer is assumed one spacing thick. `traction` and `area` refer to the face.
struct FaceLayer {
  std::vector<int> id;
  std::vector<Point> normal;    // outwards
  std::vector<Point> traction;  // Pa, at ramp factor 1
  std::vector<double> area;     // m^(dim − 1)
  bool has_edge = false;        // not a layer, but two faces that meet at an edge
};

/// Empty unless each particle `id` of the region lies with its neighbours on a line (3D: plane), with the body on one
/// side.
FaceLayer face_layer(const Load& load, const InitialParticles& initial, std::vector<int> id, double spacing);

/// Particle id and force, N.
using FaceShare = std::pair<int, Point>;

/// Distribution of a traction t by S_j = Σ_k (V_k g_kj − V_j g_jk), the surface of particle j under the gradient Σ_k
/// (f_k − f_j) g_jk: about 1.5, −0.5 and 0 dp from the outermost layer inwards.
/// - uniform: f_j = t (n · S_j). A uniform stress stays at rest to round-off, also at edges. Force and moment are
///   exact for uniform t on a whole side of a rectangle or box.
/// - by_column: shares a layer particle's force among those below it like n · S_j, with the end correction of the
///   midpoint rule at edges. The force of a linear t is exact; corners are not at rest. If Σ n · S is below half of
///   the area, the layer takes all.
/// In thin bodies S_j contains the opposite face too. Both rules then use the nearer half of the column and apply the
/// missing area at its middle; the opposite face adds the same with opposite sign.
enum class FaceRule : std::uint8_t { uniform, by_column };
/// `surface`: S by id; `reach`: range of the gradient, m.
std::vector<FaceShare> face_shares(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                   double reach, const std::vector<Point>& surface, double spacing);

}  // namespace taut
