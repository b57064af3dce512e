#pragma once

#include <array>
#include <optional>
#include <string>

#include "cli/scene_file.hpp"
#include "engine/field.hpp"
#include "render/colormap.hpp"
#include "render/renderer.hpp"

namespace CLI {
class App;
}

namespace taut {

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
  const Colormap* colormap;
  std::optional<std::array<double, 2>> range;  // in the field's unit; none = over the whole sequence
  std::optional<View> view;                    // m; none = over the whole sequence
  int width, height;                           // pixels
  bool bare = false;                           // particles only, without texts and colour bar
};

/// Throws UsageError, with the nearest names, for a field or a colour map that does not exist.
DrawingPlan plan_drawing(const Drawing& drawing);

}  // namespace taut
