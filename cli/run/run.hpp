#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "cli/drawing/drawing.hpp"
#include "cli/run/folder.hpp"
#include "cli/run/record.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/system/interrupts.hpp"
#include "cli/system/progress.hpp"

namespace taut::cli {

struct RunPlan {
  SceneFile file;
  std::optional<double> requested_spacing;  // m
  std::optional<Drawing> drawing;           // none: no frames
  bool keeps_look = false;
  std::vector<const Field*> particle_fields;  // none: not saved
  ParticleForm particle_form;
  std::string file_checksum;
  std::vector<double> frame_times, history_times;  // s, sorted
  RunFolder folder{"."};
  std::optional<double> checkpoint_every;  // simulated s; none: no regular checkpoints
  bool keep_checkpoint = false;            // for a later `until`
  std::optional<std::string> state;        // none: starts at t = 0
  bool runs_on = false;                    // `state` has an earlier `until`

  std::string scene_text() const { return resolved_text(file, folder.path()); }
  std::optional<SavedParticles> saved_particles() const;
};

/// Throws SceneError with the place in the scene file.
std::unique_ptr<Simulation> start(const SceneFile& file);

struct RunResult {
  RunRecord record;
  int frames = 0;
  std::set<std::string> cut_texts{};  // without room in the frames
  std::string failure;
};

/// `setup_seconds`: time spent reading the scene. Calls `before_it_begins` after the set-up. Throws SceneError,
/// UsageError and OutputError.
RunResult run_scene(const RunPlan& plan, const Interrupts& interrupts, Progress& progress,
                    double setup_seconds, const std::function<void()>& before_it_begins = {});

}  // namespace taut::cli
