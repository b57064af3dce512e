#pragma once

#include <optional>
#include <string>

#include "cli/run/saved_run.hpp"

namespace taut::cli {

struct PanelCell {
  std::optional<ColoredParticles> particles;
  std::string remark;  // in the corner, or centred without particles
};

/// Particles saved nearest to `time` [s], or none if the run ended earlier. The remark shows their time, if different,
/// or how the run ended.
PanelCell cell_at(const SavedRun& run, double time, double until, const Drawing& drawing,
                  const Origins& origins);

}  // namespace taut::cli
