#pragma once

#include <optional>
#include <string>

#include "cli/run/saved_run.hpp"

namespace taut::cli {

/// One picture; empty after the end of the run.
struct PanelCell {
  std::optional<ColoredParticles> particles;
  std::string remark;  // in the corner of particles, else in the middle
};

/// Particles nearest to `time` (s); a remark shows a different time. `until` (s) sets the unit.
PanelCell cell_at(const SavedRun& run, double time, double until, const Drawing& drawing,
                  const Origins& origins);

}  // namespace taut::cli
