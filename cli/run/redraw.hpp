#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "cli/run/saved_run.hpp"
#include "cli/system/progress.hpp"

namespace taut::cli {

/// Throws UsageError.
void check_redrawing(const SavedRun& run);

struct Redrawn {
  int frames = 0;
  bool all = true;                    // false after an interrupt
  std::set<std::string> cut_texts{};  // without room in the frames
};

/// Frames have the numbers of their particle files. `threads` 0: all cores.
Redrawn redraw(const SavedRun& run, const std::filesystem::path& folder, int threads, Progress& progress);

}  // namespace taut::cli
