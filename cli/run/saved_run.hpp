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

/// A run folder whose particles were saved.
struct SavedRun {
  RunFolder folder;
  SceneFile file;                       // the scene as run
  std::vector<ParticleFile> particles;  // in the order of time
};

/// UsageError if the folder is no run or holds no particles, saying how to get them.
SavedRun open_saved_run(const std::filesystem::path& folder);

/// The particles of one time, coloured by a field.
struct ColoredParticles {
  int dim = 2;
  double time = 0;                         // s
  std::vector<double> x, diameter, value;  // as in FrameView

  FrameView view() const;
};

/// As the drawing colours them; `origins` are those of the run. UsageError if a field was not saved.
ColoredParticles read_colored(const ParticleFile& file, const Drawing& drawing, const Origins& origins);

}  // namespace taut::cli
