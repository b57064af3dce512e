#pragma once

#include "cli/text/json.hpp"

namespace taut::cli {

/// JSON Schema of scene files and of sweep files (draft-07, which TOML editors read). Built from the sections, the kinds
/// of shapes, probes and measures, and the constants and laws of methods.
Json scene_schema();
Json sweep_schema();

}  // namespace taut::cli
