#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Outermost layer of a face, half a spacing inside. Tractions on the layer alone would act too deep. Normals follow
/// from the layer only, so that a corner belongs to the loaded face. `traction` and `area` refer to the face; layers
/// are one spacing thick.
struct FaceLayer {
  std::vector<int> id;
  std::vector<Point> normal;    // outwards
  std::vector<Point> traction;  // Pa, at ramp factor 1
  std::vector<double> area;     // m^(dim − 1)
  bool has_edge = false;        // not a layer: two faces meet at an edge
};

/// Layer of a load's region with particles `id`. Empty unless each lies with its neighbours in the region on a line
/// (3D: plane), with the rest of the body on one side.
FaceLayer face_layer(const Load& load, const InitialParticles& initial, std::vector<int> id, double spacing);

/// Particle id and force, N.
using FaceShare = std::pair<int, Point>;

/// Distributes a traction t by S_j = Σ_k (V_k g_kj − V_j g_jk) under the gradient Σ_k (f_k − f_j) g_jk: about 1.5,
/// −0.5 and 0 dp in the layers from outside.
/// - uniform: f_j = t (n · S_j). Uniform stress is an equilibrium to round-off. Force and moment are exact for
///   uniform t on a whole side of a rectangle or box.
/// - by_column: particles below a layer particle share its force in proportion to n · S_j, with the end correction of
///   the midpoint rule. The force of a linear t is exact, corners are not in equilibrium. If Σ n · S is below half of
///   the area, the layer takes all.
/// In thin bodies, S_j includes the opposite face. Both rules then use the nearer half of the column and apply the
/// missing area at its middle, which the opposite face balances.
enum class FaceRule : std::uint8_t { uniform, by_column };
/// `surface`: S by id; `reach`: of the gradient, m.
std::vector<FaceShare> face_shares(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                   double reach, const std::vector<Point>& surface, double spacing);

}  // namespace taut
