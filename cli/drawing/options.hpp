#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "cli/drawing/drawing.hpp"

namespace taut::cli {

class Options;

/// Drawing options of a command; others keep the scene's values.
struct DrawingOptions {
  std::map<std::string, std::optional<std::string>, std::less<>> typed;  // by key

  bool any() const;
};

/// Declares an option for every key of style.
void declare_drawing_options(Options& command, DrawingOptions& options);

/// Throws UsageError.
Drawing with_options(Drawing drawing, const DrawingOptions& options);

}  // namespace taut::cli
