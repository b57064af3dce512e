#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/layout/initial_particles.hpp"

namespace taut {

/// Outermost layer of particles, half its thickness inside a loaded face. `traction` and `area` refer to the face.
struct FaceLayer {
  std::vector<int> id;          // ascending
  std::vector<Point> normal;    // outward unit vectors
  std::vector<Point> traction;  // Pa, at ramp factor 1
  std::vector<double> area;     // m^(dim − 1)
  bool has_edge = false;        // the region covers two faces that meet
};

/// Returns an empty layer if the particles do not form a thin layer with the rest of the body on one side.
/// `load` and `id` belong to `body`.
FaceLayer face_layer(const Load& load, const Body& body, const InitialParticles& initial, std::vector<int> id,
                     double spacing);

/// Particle id and force, N.
using FaceShare = std::pair<int, Point>;

/// Distribution of a traction over the particles near a face (THEORY.md).
enum class FaceRule : std::uint8_t { uniform, by_column };
/// Force on each particle, N. `surface`: area vectors S_j by id, m^(dim − 1); `reach`: range of the gradient, m.
std::vector<FaceShare> face_shares(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                   double reach, const std::vector<Point>& surface, double spacing);

}  // namespace taut
