#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "cli/drawing/drawing.hpp"

namespace taut::cli {

class Options;

/// Drawing options of a command line. Omitted values come from the scene.
struct DrawingOptions {
  std::map<std::string, std::optional<std::string>, std::less<>> typed;  // value by key

  bool any() const;
};

void declare_drawing_options(Options& command, DrawingOptions& options);

/// Overrides `drawing` by the typed options. Throws UsageError for a wrong value.
Drawing with_options(Drawing drawing, const DrawingOptions& options);

}  // namespace taut::cli
