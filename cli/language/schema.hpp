#pragma once

#include "cli/text/json.hpp"

namespace taut::cli {

/// JSON Schema (draft-07) for TOML editors.
Json scene_schema();
Json sweep_schema();
Json claim_schema();
Json suite_schema();

}  // namespace taut::cli
