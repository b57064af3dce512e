#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// A traction on the face of a body whose outermost particles lie half a spacing inside the face. With the traction
/// only on this layer, the force would act too deep and the stress in the layer would be wrong. Inner layers
/// therefore take a part.
/// The layer contains the particles of the load's region. Normals are computed from the layer alone, so that a corner
/// belongs to the loaded face. Traction and area refer to the face, half a spacing outside. The layer is assumed one
/// spacing thick.
struct FaceLayer {
  std::vector<int> id;
  std::vector<Point> normal;    // outwards
  std::vector<Point> traction;  // Pa, where the ramp is 1
  std::vector<double> area;     // m^(dim − 1)
  bool has_edge = false;        // if the region is not a layer: it contains two faces that meet at an edge
};

/// Returns the layer of the load's region with particles `id`. Returns an empty layer if a particle has no layer
/// normal: its neighbours in the region must lie on a line (3D: plane) through it, and the rest of the body on one
/// side.
FaceLayer face_layer(const Load& load, const InitialParticles& initial, std::vector<int> id, double spacing);

/// Particle id and its share of a load, N.
using FaceShare = std::pair<int, Point>;

/// Distributes a traction t by S_j = Σ_k (V_k g_kj − V_j g_jk), the surface of particle j (by id) under the method's
/// gradient Σ_k (f_k − f_j) g_jk. On a face, S is about 1.5, −0.5 and 0 dp in the layers from the outermost one
/// inwards.
/// - uniform: f_j = t (n · S_j) balances a uniform stress σ with σ n = t to round-off, also at corners and edges.
///   Force and moment are exact for uniform t on a whole side of a rectangle or box, if the gradient is exact for
///   linear fields.
/// - by_column: each layer particle shares its force among the particles below it in proportion to n · S_j. At
///   corners and edges the areas have the end correction of the midpoint rule. The force of a t linear along the face
///   is then exact; corners are not in equilibrium. If Σ n · S is less than half of the area, the whole force acts on
///   the layer.
/// In thin bodies particles near one face also feel the opposite face, and S_j contains both. Both rules then use the
/// nearer half of the column and apply the missing area at its middle. The opposite face does the same with opposite
/// sign.
enum class FaceRule : std::uint8_t { uniform, by_column };
/// `surface`: S by id; `reach`: range of the gradient, m.
std::vector<FaceShare> face_shares(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                   double reach, const std::vector<Point>& surface, double spacing);

}  // namespace taut
