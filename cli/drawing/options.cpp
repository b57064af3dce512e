#include "cli/drawing/options.hpp"

#include <algorithm>

#include "cli/arguments/options.hpp"
#include "engine/error.hpp"

namespace taut::cli {

bool DrawingOptions::any() const {
  return std::ranges::any_of(typed, [](const auto& option) { return option.second.has_value(); });
}

bool DrawingOptions::contains(std::string_view key) const {
  const auto given = typed.find(key);
  return values.contains(key) || (given != typed.end() && given->second);
}

void declare_drawing_options(Options& command, DrawingOptions& options) {
  for (const DrawingKey& key : drawing_keys()) {
    if (key.counts_frames) continue;
    command.add(key.option(), key.placeholder, options.typed[std::string(key.name)], key.help);
  }
}

Drawing with_options(Drawing drawing, const DrawingOptions& options) {
  const std::string followed = drawing.follow;
  for (const DrawingKey& key : drawing_keys()) {
    if (const auto value = options.values.find(key.name); value != options.values.end())
      if (const std::string wrong = key.set(drawing, value->second); !wrong.empty()) throw UsageError(wrong);
    if (const auto given = options.typed.find(key.name); given != options.typed.end() && given->second)
      set_typed(drawing, key, *given->second);
  }
  // a view is relative to the followed body
  if (drawing.follow != followed && !options.contains("view")) drawing.look.view.reset();
  return drawing;
}

}  // namespace taut::cli
