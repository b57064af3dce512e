#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/drawing/drawing.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// Stored in look.json of a baseline.
struct KeptLook {
  std::string color;                   // key, or "=EXPRESSION"
  std::optional<render::Range> range;  // none: bodies or materials
  std::optional<render::View> view;    // none: orbit
  double front = 0;                    // 3D: `Camera::front`, m
};

KeptLook look_of(const Drawing& drawn);
/// Sets missing range and view, if they apply to `drawing`.
void set_open(Drawing& drawing, const KeptLook& look);

Json to_json(const KeptLook& look);
/// Returns nullopt if unreadable. Throws UsageError if damaged.
std::optional<KeptLook> read_look(const std::filesystem::path& file);

}  // namespace taut::cli
