#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "cli/drawing/drawing.hpp"
#include "cli/drawing/keys.hpp"

namespace taut::cli {

class Options;

/// Omitted values come from the scene.
struct DrawingOptions {
  std::map<std::string, std::optional<std::string>, std::less<>> typed;
  DrawingValues values;  // of a suite file; `typed` has priority

  bool any() const;
  bool contains(std::string_view key) const;
};

void declare_drawing_options(Options& command, DrawingOptions& options);

/// If the followed body changes, the view becomes automatic unless `options` contain a view.
Drawing with_options(Drawing drawing, const DrawingOptions& options);

}  // namespace taut::cli
