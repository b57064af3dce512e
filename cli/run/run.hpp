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
  std::optional<double> requested_spacing;    // m, from the scene or the command line
  std::optional<Drawing> drawing;             // none: no frames
  bool keeps_look = false;                    // writes look.json after the frames
  std::vector<const Field*> particle_fields;  // none: not saved
  std::vector<double> frame_times,
      history_times;  // s, sorted; particles are saved at frame times
  RunFolder folder{"."};
  std::optional<double> checkpoint_every;  // simulated time, s; none: no checkpoints
  bool keep_checkpoint = false;            // when the run has finished, to continue it to a later `until`
  std::optional<std::string> state;        // of the run in the folder, to continue it; none: from the start
  bool runs_on = false;                    // `state` is of a run with an earlier `until`

  std::string scene_text() const { return resolved_text(file, folder.path()); }
};

/// Creates the simulation. Errors about the scene contain their place in the file.
std::unique_ptr<Simulation> start(const SceneFile& file);

struct RunResult {
  RunRecord record;
  int frames = 0;       // number written
  std::string failure;  // reason of an early end, or empty
};

/// Simulates `plan` and writes its run folder. Throws OutputError, and the errors of make_simulation before any
/// change of the folder. `setup_seconds` is the time spent on reading the scene. `before_it_begins` is called after
/// all checks, before the folder changes.
RunResult run_scene(const RunPlan& plan, const Interrupts& interrupts, Progress& progress,
                    double setup_seconds, const std::function<void()>& before_it_begins = {});

}  // namespace taut::cli
