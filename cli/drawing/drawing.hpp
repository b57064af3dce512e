#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/diagnostics/fields.hpp"
#include "engine/scene/scene.hpp"
#include "render/look.hpp"

namespace taut::cli {

inline constexpr int most_frames = 1000000;

/// As what a particle is drawn.
enum class Style : std::uint8_t { discs, spheres, cells };

/// What is drawn of a run, and how. An open colour map goes by the field: viridis, or diverging for signed
/// fields; an open range or view holds all that is shown. A scene in 3D has a camera and no view of its own.
struct Drawing {
  const Field* field = find_field("von_mises");  // that the particles are coloured by
  render::Look look;
  int frames = 60;               // evenly spaced after the one at t = 0
  std::optional<Style> style{};  // open: discs in 2D, spheres in 3D
  std::string cut{};     // expression: where it is not 0 at the start, particles are not drawn; or empty
  std::string follow{};  // the body whose centre of mass stays in the middle; or empty

  bool orbit = false;  // 3D: the camera goes once about what it sees, from the first frame to the last

  // what the scene makes of the last two, see `suit` in cli/scene
  Expression is_cut{};
  std::optional<int> followed{};  // index into Scene::bodies
};

std::vector<std::string> names_of_fields();
std::vector<std::string> names_of_fields(int dim);
/// Throws UsageError, with the nearest name, for a field that does not exist in scenes of `dim` dimensions.
const Field& known_field(const std::string& key, int dim = 3);

}  // namespace taut::cli
