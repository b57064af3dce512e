#pragma once

#include <optional>
#include <string>

#include "cli/run/saved_run.hpp"

namespace taut::cli {

/// One picture of a panel; without particles after the end of the run.
struct PanelCell {
  std::optional<ColoredParticles> particles;
  std::string remark;  // in the corner with particles, else in the middle
};

/// The saved particles nearest to `time` (s); a remark shows a different time. `until` (s) sets the unit of times.
PanelCell cell_at(const SavedRun& run, double time, double until, const Drawing& drawing,
                  const Origins& origins);

}  // namespace taut::cli
