#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "cli/run/plan.hpp"
#include "cli/study/study.hpp"
#include "cli/sweep/grid.hpp"

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

/// CPU cost of equal runs.
struct RepeatedCost {
  int runs = 0;
  const RunRecord* median;  // of the run with the median CPU time
  double spread = 0;        // greatest less least CPU time, over the median
};

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
  std::string problem;                // of a broken run
  std::optional<RunRecord> record;    // if done or interrupted
  std::vector<SweepRun> repetitions;  // further runs, for the cost

  /// This run and its repetitions.
  std::vector<SweepRun*> all();
  /// Cost of this run and its repetitions, as far as they have results.
  std::optional<RepeatedCost> cost() const;
  bool has_diverged() const { return record && record->status == RunRecord::Status::failed; }
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
  int repeat = 1;  // runs of each row
  StudyPictures pictures;
};

/// Checks all runs and pictures, and reads the run folders; starts no run. Throws SceneError with the place in the
/// sweep file, or UsageError with the run.
SweepPlan plan_sweep(const SweepRequest& request);

}  // namespace taut::cli
