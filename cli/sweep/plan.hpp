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
  outdated,     // other settings, input files or version
  interrupted,  // run.json without a result
  damaged,      // unreadable run.json
  broken,       // crash, kill or error
  done,         // finished or diverged
};
std::string_view name(SweepRunState);

/// CPU time of equal runs.
struct RepeatedCost {
  int runs = 0;
  const RunRecord* median;
  double spread = 0;  // (maximum − minimum)/median
};

struct SweepRun {
  int index = 0;
  GridRow settings;
  RunOptions options;
  std::string folder;
  std::string scene, file_checksum;
  std::optional<SavedParticles> saved_particles;
  int last_frame = -1;  // -1: none
  double work = 0;      // relative duration
  bool forced = false;  // repeat even if done
  SweepRunState state = SweepRunState::to_do;
  std::string problem;
  std::optional<RunRecord> record;
  double seconds = 0;  // wall time
  std::vector<SweepRun> repetitions;

  /// Includes repetitions.
  std::vector<SweepRun*> all();
  std::optional<RepeatedCost> cost() const;
  /// Returns this run or its first repetition without a result; this run if all have one.
  const SweepRun& first_unfinished() const;
  bool has_diverged() const { return record && record->status == RunRecord::Status::failed; }
  void read_folder();
  void forget();
};

struct Swept {
  std::string name;
  std::string unit, help;  // of parameters
};

struct SweepPlan {
  std::string title;
  std::string scene;
  std::filesystem::path folder;
  std::vector<Swept> swept;
  std::vector<Setting> fixed;
  std::vector<SweepRun> runs;  // in grid order
  StudyPictures pictures;
  std::set<std::string> remarks;
};

/// Settings from a file have a place.
struct SweepRequest {
  std::string title;
  std::filesystem::path file;  // empty: command line
  RunOptions base;
  std::vector<Setting> set;  // of the file, without names of `base`
  std::filesystem::path folder;
  std::vector<GridRow> rows;
  int repeat = 1;
  StudyPictures pictures;
};

/// Throws SceneError and UsageError.
SweepPlan plan_sweep(const SweepRequest& request);

}  // namespace taut::cli
