#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
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

enum class Style : std::uint8_t { discs, spheres, cells, surface };
/// Lines around bodies in 2D.
enum class Outlines : std::uint8_t { none, deformed, undeformed, both };

struct ColorFormula {
  /// Current and initial position.
  static constexpr std::array<const char*, 6> places{"x", "y", "z", "X", "Y", "Z"};
  using Function = std::function<double(const std::vector<double>&, double t)>;

  std::vector<const Field*> fields;
  Function function;  // of the fields, `places` and the time

  /// One value per particle. `of_fields`: values of each field; x, x0: `dim` coordinates each, m.
  std::vector<double> values(std::span<const std::vector<double>> of_fields, int dim,
                             std::span<const double> x, std::span<const double> x0, double time) const;
};

/// `fitted` sets open members: viridis, or a diverging map for signed fields; range and view of everything shown. In
/// 3D, a camera replaces the view.
struct Drawing {
  const Field* field = find_field("von_mises");  // without a `formula`
  render::Look look{};
  int frames = 60;               // after t = 0, evenly spaced
  std::optional<Style> style{};  // default: discs in 2D, spheres in 3D
  std::string cut{};             // expression that hides particles where it is not 0 at the start
  std::string hide{};            // bodies that are not drawn, with commas between
  Outlines outline = Outlines::none;
  std::string follow{};  // body whose centre of mass stays in the middle

  std::optional<std::string> title{};   // default: the scene's; empty: none
  std::optional<double> font_points{};  // default: by the size, or print_font
  std::optional<double> dpi{};          // default: screen_dpi or print_dpi
  std::string print_width{};            // "85mm", or empty

  std::string formula{};  // expression of the colours
  bool orbit = false;     // 3D: one circle of the camera

  // set by `apply_scene` (cli/scene)
  Expression is_cut{};
  std::optional<int> followed{};         // index into Scene::bodies
  std::vector<int> hidden{};             // indices into Scene::bodies
  std::shared_ptr<const Scene> scene{};  // for surfaces and outlines, else null
  std::vector<WallFace> walls{};
  double round_off = 0;  // minimum width of an open range, in the unit of the colours
  ColorFormula of_formula{};
};

/// `print_width` in pixels, if given.
std::optional<double> pixels_on_paper(const Drawing& drawing);
/// Applies font size and width on paper, keeping the proportions. An open size stays open.
Drawing sized(Drawing drawing);

struct ColorMeaning {
  std::string_view name, unit;
  std::optional<double> middle;  // neutral value of a signed field
};
ColorMeaning meaning(const Drawing& drawing);
/// In the field's unit.
std::vector<double> color_values(const Drawing& drawing, const Snapshot& snapshot);

std::vector<std::string> names_of_fields();
std::vector<std::string> names_of_fields(int dim);
/// Throws UsageError for a field that scenes of `dim` dimensions lack.
const Field& known_field(const std::string& key, int dim = 3);

}  // namespace taut::cli
