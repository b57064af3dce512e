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

/// A run with saved particles.
struct SavedRun {
  RunFolder folder;
  SceneFile file;
  std::vector<ParticleFile> particles;  // in order of time
};

/// Throws UsageError if there are no particles.
SavedRun open_saved_run(const std::filesystem::path& folder);

/// Particles with their colour values.
struct ColoredParticles {
  int dim = 2;
  double time = 0;                         // s
  std::vector<double> x, diameter, value;  // as in FrameView

  FrameView view() const;
};

/// `origins` belong to the run. UsageError if a field was not saved.
ColoredParticles read_colored(const ParticleFile& file, const Drawing& drawing, const Origins& origins);

}  // namespace taut::cli
