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

/// State of a run, from its folder.
enum class RunState {
  to_do,
  outdated,     // other settings or version of taut
  interrupted,  // or killed
  damaged,      // unreadable run.json
  broken,       // crashed or not written
  done,         // finished or diverged
};
std::string_view name(RunState);

/// A validated run of a sweep.
struct SweepRun {
  int index = 0;
  GridRow settings;     // swept settings
  RunOptions options;   // complete options
  std::string folder;   // in the sweep's folder
  std::string scene;    // future scene.toml
  int last_frame = -1;  // -1: none
  double work = 0;      // relative duration, estimated from spacing and steps
  bool forced = false;  // repeat even if done
  RunState state = RunState::to_do;
  std::string problem;  // of a broken run
  Json record;          // run.json if done or interrupted, else null

  void read_folder();
  /// Resets to an empty folder.
  void forget();
};

struct Swept {
  std::string name;
  std::string unit, help;  // of a scene parameter
};

struct SweepPlan {
  std::string title;
  std::string scene;  // its name
  std::filesystem::path folder;
  std::vector<Swept> swept;
  std::vector<Setting> fixed;  // for all runs
  std::vector<SweepRun> runs;  // in grid order
  StudyPictures pictures;
  std::set<std::string> remarks;  // about its scenes
};

/// Settings from a file include their place.
struct SweepRequest {
  std::string title;
  std::filesystem::path file;  // empty: command line
  RunOptions base;
  std::vector<Setting> set;  // for all runs, from the file; no name of `base`
  std::filesystem::path folder;
  std::vector<GridRow> rows;
  StudyPictures pictures;
};

/// Checks every run and picture and reads the run folders; starts nothing. Throws SceneError with the place in the
/// sweep file, or UsageError with the run.
SweepPlan plan_sweep(const SweepRequest& request);

}  // namespace taut::cli
