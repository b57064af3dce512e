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
enum class Outlines : std::uint8_t { none, deformed, undeformed, both };

struct ColorFormula {
  static constexpr std::array<const char*, 6> places{"x", "y", "z", "X", "Y", "Z"};
  using Function = std::function<double(const std::vector<double>&, double t)>;

  std::vector<const Field*> fields;
  Function function;  // of fields, `places` and time

  /// x, x0: `dim` coordinates per particle, m.
  std::vector<double> values(std::span<const std::vector<double>> of_fields, int dim,
                             std::span<const double> x, std::span<const double> x0, double time) const;
};

/// `look` may be incomplete; see fitted().
struct Drawing {
  const Field* field = find_field("von_mises");
  render::Look look{};
  int frames = 60;               // evenly spaced after t = 0
  std::optional<Style> style{};  // default: discs, in 3D spheres
  std::string cut{};             // expression of the reference position; not 0 hides the particle
  std::string hide{};            // bodies, separated by commas
  Outlines outline = Outlines::none;
  std::string follow{};  // body that stays centred

  std::optional<std::string> title{};  // empty: none; default: the scene's
  std::optional<double> font_points{};
  std::optional<double> dpi{};
  std::string print_width{};  // "85mm", or empty

  std::string formula{};
  bool orbit = false;

  // from the scene
  Expression is_cut{};
  std::optional<int> followed{};
  std::vector<int> hidden{};
  std::shared_ptr<const Scene> scene{};
  std::vector<WallFace> walls{};
  double round_off = 0;  // minimum width of an automatic range
  ColorFormula of_formula{};
};

std::optional<double> pixels_on_paper(const Drawing& drawing);
/// Applies print width and font size.
Drawing sized(Drawing drawing);

struct ColorMeaning {
  std::string_view name, unit;
  std::optional<double> middle;  // of a symmetric colour range
};
ColorMeaning meaning(const Drawing& drawing);
/// In the unit of `meaning`.
std::vector<double> color_values(const Drawing& drawing, const Snapshot& snapshot);

std::vector<std::string> names_of_fields();
std::vector<std::string> names_of_fields(int dim);
/// Throws UsageError for an unknown field.
const Field& known_field(const std::string& key, int dim = 3);

}  // namespace taut::cli
