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

/// What a run folder says of a run of a sweep.
enum class RunState {
  to_do,
  outdated,     // an older run with other settings, or of another version of taut
  interrupted,  // or killed
  damaged,      // its run.json is not whole
  broken,       // it ended without a result: a crash, a full disk
  done,         // finished or diverged: a result either way
};
std::string_view name(RunState);

/// One run of a sweep, checked.
struct SweepRun {
  int index = 0;
  GridRow settings;     // what it sets, as the grid has it
  RunOptions options;   // all of it, as for `taut run`
  std::string folder;   // inside the sweep's
  std::string scene;    // scene.toml as it will be
  int last_frame = -1;  // none: -1
  double work = 0;      // in proportion to the time it will take, as far as spacing and steps tell
  bool forced = false;  // it is to be done, whatever its folder says
  RunState state = RunState::to_do;
  std::string problem;  // of a broken run
  Json record;          // run.json of a run that is done or was interrupted; else null

  /// Reads state and record from the run folder.
  void read_folder();
  /// As if its folder were empty.
  void forget();
};

/// A name that the runs set in different ways.
struct Swept {
  std::string name;
  std::string unit, help;  // of a scene's parameter
};

struct SweepPlan {
  std::string title;
  std::string scene;  // its name
  std::filesystem::path folder;
  std::vector<Swept> swept;
  std::vector<Setting> fixed;  // what is set for all runs
  std::vector<SweepRun> runs;  // in the order of the grid
  StudyPictures pictures;
  std::set<std::string> remarks;  // of the readings of its scenes
};

/// What is asked for: `base` is common to all runs; settings that stand in a file know their place.
struct SweepRequest {
  std::string title;
  std::filesystem::path file;  // empty: the grid stands on the command line
  RunOptions base;
  std::vector<Setting> set;  // for all runs, from the file; no name of `base`
  std::filesystem::path folder;
  std::vector<GridRow> rows;
  StudyPictures pictures;  // to be drawn from the results
};

/// Reads the scene as every run will see it and what its folder holds; starts nothing. A name, a value or a
/// method that a run cannot have, or a picture that cannot be drawn, is an error here: SceneError with the
/// place in the sweep file, or UsageError that names the run.
SweepPlan plan_sweep(const SweepRequest& request);

}  // namespace taut::cli
