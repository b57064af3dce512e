#pragma once

#include "cli/text/json.hpp"

namespace taut::cli {

/// JSON Schema (draft-07) of scene and sweep files for TOML editors.
Json scene_schema();
Json sweep_schema();

}  // namespace taut::cli
