#pragma once

#include <optional>
#include <string>

#include "cli/run/saved_run.hpp"

namespace taut::cli {

struct PanelCell {
  std::optional<ColoredParticles> particles;
  std::string remark;  // in the corner, or in the middle without particles
};

/// Returns the saved particles nearest to `time` (s); none after the end of the run. If they are of another time, the
/// remark contains it, in the unit of `until` (s).
PanelCell cell_at(const SavedRun& run, double time, double until, const Drawing& drawing,
                  const Origins& origins);

}  // namespace taut::cli
