#pragma once

#include <filesystem>
#include <vector>

#include "cli/drawing/drawing.hpp"
#include "cli/drawing/staging.hpp"
#include "cli/formats/particle_file.hpp"
#include "cli/run/folder.hpp"
#include "cli/scene/scene_file.hpp"
#include "engine/frame_view.hpp"

namespace taut::cli {

/// A run folder with saved particles.
struct SavedRun {
  RunFolder folder;
  SceneFile file;                       // as run
  std::vector<ParticleFile> particles;  // in order of time
};

/// Throws UsageError if the folder is not a run or has no particles, with the remedy.
SavedRun open_saved_run(const std::filesystem::path& folder);

/// Particles at one time with their colour values.
struct ColoredParticles {
  int dim = 2;
  double time = 0;                         // s
  std::vector<double> x, diameter, value;  // as in FrameView

  FrameView view() const;
};

/// Reads particles for a drawing; `origins` belong to the run. UsageError if a field was not saved.
ColoredParticles read_colored(const ParticleFile& file, const Drawing& drawing, const Origins& origins);

}  // namespace taut::cli
