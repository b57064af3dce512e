#pragma once

#include <optional>
#include <string>

#include "cli/run/saved_run.hpp"

namespace taut::cli {

struct PanelCell {
  std::optional<ColoredParticles> particles;
  std::string remark;  // in the corner, or in the middle without particles
};

/// Particles nearest to `time` (s), with their time if different, in the unit of `until` (s). None after the run's
/// end.
PanelCell cell_at(const SavedRun& run, double time, double until, const Drawing& drawing,
                  const Origins& origins);

}  // namespace taut::cli
