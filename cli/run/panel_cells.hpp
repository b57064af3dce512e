#pragma once

#include <optional>
#include <string>

#include "cli/run/saved_run.hpp"

namespace taut::cli {

/// One picture of a panel; no particles where the run had ended.
struct PanelCell {
  std::optional<ColoredParticles> particles;
  std::string remark;  // in the corner with particles, in the middle without
};

/// The saved particles nearest to `time` (s), with a remark where they are of another time than that. `until`
/// (s) gives the unit of all times of the panel.
PanelCell cell_at(const SavedRun& run, double time, double until, const Drawing& drawing,
                  const Origins& origins);

}  // namespace taut::cli
