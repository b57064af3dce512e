#pragma once

#include <filesystem>
#include <optional>

#include "cli/run/saved_run.hpp"
#include "cli/system/progress.hpp"

namespace taut::cli {

/// UsageError where the drawing of a run cannot be drawn from its particles.
void check_redrawing(const SavedRun& run);

/// How many frames were drawn into `folder`, and whether that is all of them: an interrupt ends it.
struct Redrawn {
  int frames = 0;
  bool all = true;
};

/// Draws all frames of a run from its particles, as its drawing says. `threads` of 0: as many as there are
/// cores.
Redrawn redraw(const SavedRun& run, const std::filesystem::path& folder, int threads, Progress& progress);

}  // namespace taut::cli
