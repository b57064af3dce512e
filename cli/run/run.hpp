#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cli/drawing/drawing.hpp"
#include "cli/run/folder.hpp"
#include "cli/run/record.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/system/interrupts.hpp"
#include "cli/system/progress.hpp"

namespace taut::cli {

/// A validated run.
struct RunPlan {
  SceneFile file;
  std::optional<double> spacing_asked;        // m
  std::optional<Drawing> drawing;             // none: no frames
  std::vector<const Field*> particle_fields;  // none: not saved
  std::vector<double> frame_times,
      history_times;  // s, sorted; particles: frame times
  RunFolder folder{"."};
  std::optional<double> checkpoint_every;  // simulated time, s
  std::optional<std::string> state;        // to continue from; none: start

  std::string scene_text() const { return resolved_text(file, folder.path()); }
};

std::unique_ptr<Simulation> start(const SceneFile& file);

struct RunResult {
  RunRecord record;
  int frames = 0;       // number written
  std::string failure;  // empty: none
};

/// Simulates `plan`. Throws OutputError; before changing the folder, also the errors of make_simulation.
/// `setup_seconds` were spent on reading. `before_it_begins` precedes changes of the folder.
RunResult run_scene(const RunPlan& plan, const Interrupts& interrupts, Progress& progress,
                    double setup_seconds, const std::function<void()>& before_it_begins = {});

}  // namespace taut::cli
