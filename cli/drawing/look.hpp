#pragma once

#include <array>
#include <optional>
#include <string>

#include "engine/diagnostics/fields.hpp"
#include "render/colormap.hpp"
#include "render/renderer.hpp"

namespace CLI {
class App;
}

namespace taut::cli {

/// How a scene wants to be drawn.
struct Drawing {
  std::string color = "von_mises";
  std::optional<std::array<double, 2>> range;  // in the field's SI unit; none = auto, over the whole sequence
  std::string colormap;                       // empty = by the field: viridis, or diverging for signed fields
  std::optional<std::array<double, 4>> view;  // x_min, x_max, y_min, y_max, m; none = from the particles
  std::array<int, 2> size{1280, 720};         // pixels
  int frames = 60;                            // evenly spaced after the one at t = 0
};

/// The drawing options of a command as typed; what is left out stands in the scene.
struct DrawingOptions {
  std::optional<std::string> color, range, colormap, view, size;
};

void declare_drawing_options(CLI::App& app, DrawingOptions& options);

/// What `drawing` becomes with the options. A range and a colour map of the scene belong to the scene's own
/// field: another field does without them. Throws UsageError.
Drawing with_options(Drawing drawing, const DrawingOptions& options);

/// Throws UsageError, with the nearest name, for a field that does not exist.
const Field& known_field(const std::string& key);

/// How the frames of a run are drawn: the names of a Drawing looked up.
struct DrawingPlan {
  const Field* field;
  const render::Colormap* colormap;
  std::optional<std::array<double, 2>> range;  // in the field's unit; none = over the whole sequence
  std::optional<render::View> view;            // m; none = over the whole sequence
  int width, height;                           // pixels
  bool bare = false;                           // particles only, without texts and colour bar
};

/// Throws UsageError, with the nearest names, for a field or a colour map that does not exist.
DrawingPlan plan_drawing(const Drawing& drawing);

}  // namespace taut::cli
