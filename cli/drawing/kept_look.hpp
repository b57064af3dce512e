#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/drawing/drawing.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// Colour range and view of drawn frames: the file look.json of a baseline. Later frames with this look have the same
/// scale, even if the motion, from which an automatic range and view follow, has changed.
struct KeptLook {
  std::string color;                   // key of the field, or "=EXPRESSION": the range is of its values
  std::optional<render::Range> range;  // none: one colour per body or material
  std::optional<render::View> view;    // none: of a camera on an orbit
  double front = 0;  // 3D: coordinate of the nearest particle along the camera's direction, m
};

/// Look of frames that were drawn with `drawn`, whose range and view are set.
KeptLook look_of(const Drawing& drawn);
/// Sets an open view, and an open range if the colours are of the same field.
void set_open(Drawing& drawing, const KeptLook& look);

Json to_json(const KeptLook& look);
/// Returns nullopt for a missing file. Throws UsageError for a damaged one.
std::optional<KeptLook> read_look(const std::filesystem::path& file);

}  // namespace taut::cli
