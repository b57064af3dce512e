#pragma once

#include "cli/text/json.hpp"

namespace taut::cli {

/// JSON Schema of scene files and of sweep files (draft-07, which TOML editors read), from the tables of
/// `scene_sections()` and `sweep_sections()`.
Json scene_schema();
Json sweep_schema();

}  // namespace taut::cli
