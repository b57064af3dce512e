#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "cli/drawing/drawing.hpp"

namespace taut::cli {

class Options;

/// The drawing options of a command as typed; what is left out stands in the scene.
struct DrawingOptions {
  std::map<std::string, std::optional<std::string>, std::less<>> typed;  // by key

  bool any() const;
};

/// An option for every key of drawing that says how a picture looks.
void declare_drawing_options(Options& command, DrawingOptions& options);

/// What `drawing` becomes with the options. Throws UsageError.
Drawing with_options(Drawing drawing, const DrawingOptions& options);

}  // namespace taut::cli
