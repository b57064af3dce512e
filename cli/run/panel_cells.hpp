#pragma once

#include <optional>
#include <string>

#include "cli/run/saved_run.hpp"

namespace taut::cli {

struct PanelCell {
  std::optional<ColoredParticles> particles;
  std::string remark;  // in the corner, or centred without particles
};

/// The saved particles with the time nearest to `time` [s]; none after the end of the run. The remark shows a
/// different time, or how the run ended.
PanelCell cell_at(const SavedRun& run, double time, double until, const Drawing& drawing,
                  const Origins& origins);

}  // namespace taut::cli
