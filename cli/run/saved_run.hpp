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

struct SavedRun {
  RunFolder folder;
  SceneFile file;
  std::vector<ParticleFile> particles;
  std::vector<int> numbers;  // in the file names
};

/// Throws SceneError, and UsageError without a run or .vtp files.
SavedRun open_saved_run(const std::filesystem::path& folder);

/// Missing files below the last number.
std::vector<std::string> missing_files(const SavedRun& run);

struct ColoredParticles {
  int dim = 2;
  double time = 0;                         // s
  std::vector<double> x, diameter, value;  // as in FrameView

  FrameView view() const;
};

/// Throws UsageError.
ColoredParticles read_colored(const ParticleFile& file, const Drawing& drawing, const Origins& origins);

}  // namespace taut::cli
