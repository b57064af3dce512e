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
  std::optional<double> spacing_asked;        // requested spacing, m
  std::optional<Drawing> drawing;             // none: no frames
  std::vector<const Field*> particle_fields;  // none: particles are not saved
  std::vector<double> frame_times,
      history_times;  // s, sorted; particles are saved at frame times
  RunFolder folder{"."};
  std::optional<double> checkpoint_every;  // simulated time, s; none: no checkpoints
  std::optional<std::string> state;        // state to continue from; none: from the start

  /// Text of scene.toml.
  std::string scene_text() const { return resolved_text(file, folder.path()); }
};

/// Creates the simulation; scene errors get their place in the file.
std::unique_ptr<Simulation> start(const SceneFile& file);

struct RunResult {
  RunRecord record;
  int frames = 0;       // number written
  std::string failure;  // reason of an early stop; empty: none
};

/// Simulates `plan` into its run folder. Throws OutputError, and the errors of make_simulation before it changes the
/// folder. `setup_seconds`: time already spent on the scene. `before_it_begins` is called after the set-up, before
/// the folder changes.
RunResult run_scene(const RunPlan& plan, const Interrupts& interrupts, Progress& progress,
                    double setup_seconds, const std::function<void()>& before_it_begins = {});

}  // namespace taut::cli
