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

/// What a run is to do, checked: nothing in it can be wrong any more.
struct RunPlan {
  SceneFile file;
  std::optional<double> spacing_asked;        // m, by the scene or the command line
  std::optional<Drawing> drawing;             // none: no frames
  std::vector<const Field*> particle_fields;  // none: particles are not saved
  std::vector<double> frame_times,
      history_times;  // s, sorted; particles are saved at those of the frames
  RunFolder folder{"."};
  std::optional<double> checkpoint_every;  // s of the simulation; none: no checkpoints
  std::optional<std::string> state;        // of the run in the folder, to go on with; none: from the start

  /// Of scene.toml.
  std::string scene_text() const { return resolved_text(file, folder.path()); }
};

/// The simulation of a scene file; an error about the scene gets its place in the file.
std::unique_ptr<Simulation> start(const SceneFile& file);

struct RunResult {
  RunRecord record;
  int frames = 0;       // written
  std::string failure;  // why the run stopped early; empty if it did not fail
};

/// Simulates `plan` and leaves its run folder. Throws OutputError, and what make_simulation throws before the
/// folder is touched. `setup_seconds` is what the caller has spent on reading the scene; `before_it_begins` is called
/// when nothing stands in the way of the run any more, and the folder is as it was.
RunResult run_scene(const RunPlan& plan, const Interrupts& interrupts, Progress& progress,
                    double setup_seconds, const std::function<void()>& before_it_begins = {});

}  // namespace taut::cli
