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

enum class RunState {
  to_do,
  outdated,     // other settings or version
  interrupted,  // or killed
  damaged,      // unreadable run.json
  broken,       // ended without a result
  done,         // finished or diverged
};
std::string_view name(RunState);

/// A validated run.
struct SweepRun {
  int index = 0;
  GridRow settings;  // swept
  RunOptions options;
  std::string folder;   // in the sweep's folder
  std::string scene;    // future scene.toml
  int last_frame = -1;  // -1: none
  double work = 0;      // relative duration, estimated
  bool forced = false;  // repeat even if done
  RunState state = RunState::to_do;
  std::string problem;  // of a broken run
  Json record;          // run.json if done or interrupted, else null

  void read_folder();
  void forget();
};

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
  std::set<std::string> remarks;
};

/// Settings from files contain their place.
struct SweepRequest {
  std::string title;
  std::filesystem::path file;  // empty: command line
  RunOptions base;
  std::vector<Setting> set;  // from the file; no name of `base`
  std::filesystem::path folder;
  std::vector<GridRow> rows;
  StudyPictures pictures;
};

/// Checks all runs and pictures, reads run folders, starts nothing. Throws SceneError with the place in the sweep
/// file, or UsageError with the run.
SweepPlan plan_sweep(const SweepRequest& request);

}  // namespace taut::cli
