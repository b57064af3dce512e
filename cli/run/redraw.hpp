#pragma once

#include <filesystem>
#include <optional>

#include "cli/run/saved_run.hpp"
#include "cli/system/progress.hpp"

namespace taut::cli {

/// Throws UsageError if the saved particles do not suffice for the run's drawing.
void check_redrawing(const SavedRun& run);

/// Number of frames drawn. `all` is false after an interrupt.
struct Redrawn {
  int frames = 0;
  bool all = true;
};

/// Draws all frames of a run from its saved particles; a frame has the number of its particle file. `threads` of 0
/// uses all cores.
Redrawn redraw(const SavedRun& run, const std::filesystem::path& folder, int threads, Progress& progress);

}  // namespace taut::cli
