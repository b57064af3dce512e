#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/drawing/drawing.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// File look.json of a baseline: colour range and view of all later frames.
struct KeptLook {
  std::string color;                   // key, or "=EXPRESSION"
  std::optional<render::Range> range;  // none: bodies or materials
  std::optional<render::View> view;    // none: orbit
  double front = 0;                    // 3D: `Camera::front`, m
};

KeptLook look_of(const Drawing& drawn);
/// Sets a missing view, and a missing range of the same field.
void set_open(Drawing& drawing, const KeptLook& look);

Json to_json(const KeptLook& look);
/// Returns nullopt if missing. Throws UsageError if damaged.
std::optional<KeptLook> read_look(const std::filesystem::path& file);

}  // namespace taut::cli
