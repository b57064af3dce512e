#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/diagnostics/fields.hpp"
#include "engine/frame_view.hpp"
#include "engine/scene/scene.hpp"
#include "render/look.hpp"

namespace taut::cli {

inline constexpr int most_frames = 1000000;

/// As what a particle is drawn.
enum class Style : std::uint8_t { discs, spheres, cells };

/// An expression of fields, places and time that particles are coloured by.
struct ColorFormula {
  /// Of the present and the initial position.
  static constexpr std::array<const char*, 6> places{"x", "y", "z", "X", "Y", "Z"};
  using Function = std::function<double(const std::vector<double>&, double t)>;

  std::vector<const Field*> fields;  // that it has
  Function function;                 // of these and `places`, and of the time

  /// One for each particle. `of_fields` are the values of each of `fields`; x and x0 have `dim` coordinates
  /// each, m.
  std::vector<double> values(std::span<const std::vector<double>> of_fields, int dim,
                             std::span<const double> x, std::span<const double> x0, double time) const;
};

/// What is drawn of a run, and how. An open colour map goes by the field: viridis, or diverging for signed
/// fields; an open range or view holds all that is shown. A scene in 3D has a camera and no view of its own.
struct Drawing {
  const Field* field =
      find_field("von_mises");  // that the particles are coloured by, where `formula` is empty
  render::Look look{};
  int frames = 60;               // evenly spaced after the one at t = 0
  std::optional<Style> style{};  // open: discs in 2D, spheres in 3D
  std::string cut{};     // expression: where it is not 0 at the start, particles are not drawn; or empty
  std::string follow{};  // the body whose centre of mass stays in the middle; or empty

  std::string formula{};  // expression that they are coloured by, see ColorFormula; or empty
  bool orbit = false;     // 3D: the camera goes once about what it sees, from the first frame to the last

  // what the scene makes of these texts, see `suit` in cli/scene; names of bodies and materials are in the
  // look
  Expression is_cut{};
  std::optional<int> followed{};  // index into Scene::bodies
  std::vector<WallFace> walls{};
  double round_off = 0;  // an open range is no narrower, in the unit of the colours
  ColorFormula of_formula{};
};

/// What the colours of a drawing stand for.
struct ColorMeaning {
  std::string_view name, unit;   // of the drawing
  std::optional<double> middle;  // of what lies to both sides of something
};
ColorMeaning meaning(const Drawing& drawing);
/// Of the particles of a run, in the field's unit.
std::vector<double> color_values(const Drawing& drawing, const Snapshot& snapshot);

std::vector<std::string> names_of_fields();
std::vector<std::string> names_of_fields(int dim);
/// Throws UsageError, with the nearest name, for a field that does not exist in scenes of `dim` dimensions.
const Field& known_field(const std::string& key, int dim = 3);

}  // namespace taut::cli
