#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "cli/run/plan.hpp"
#include "cli/study/study.hpp"
#include "cli/sweep/grid.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

enum class SweepRunState {
  to_do,
  outdated,     // the folder has a run of other settings or of another version
  interrupted,  // or killed
  damaged,      // unreadable run.json
  broken,       // ended without a result: crash or full disk
  done,         // finished or diverged: both are results
};
std::string_view name(SweepRunState);

/// A validated run.
struct SweepRun {
  int index = 0;
  GridRow settings;  // swept settings, as in the grid
  RunOptions options;
  std::string folder;   // in the sweep's folder
  std::string scene;    // text of scene.toml that the run will write
  int last_frame = -1;  // -1: none
  double work = 0;      // relative duration, estimated
  bool forced = false;  // repeat even if done
  SweepRunState state = SweepRunState::to_do;
  std::string problem;  // of a broken run
  Json record;          // run.json if done or interrupted, else null

  /// Reads state and record from the run folder.
  void read_folder();
  /// Resets state and record, as for an empty folder.
  void forget();
};

/// A name with different values in the runs.
struct Swept {
  std::string name;
  std::string unit, help;  // of a parameter
};

struct SweepPlan {
  std::string title;
  std::string scene;
  std::filesystem::path folder;
  std::vector<Swept> swept;
  std::vector<Setting> fixed;  // for all runs
  std::vector<SweepRun> runs;  // in grid order
  StudyPictures pictures;
  std::set<std::string> remarks;  // of its scenes
};

/// A sweep as requested. Settings from a file contain their place.
struct SweepRequest {
  std::string title;
  std::filesystem::path file;  // empty: command line
  RunOptions base;             // for all runs
  std::vector<Setting> set;    // from the file; no name of `base`
  std::filesystem::path folder;
  std::vector<GridRow> rows;
  StudyPictures pictures;
};

/// Checks all runs and pictures, and reads the run folders; starts no run. Throws SceneError with the place in the
/// sweep file, or UsageError with the run.
SweepPlan plan_sweep(const SweepRequest& request);

}  // namespace taut::cli
