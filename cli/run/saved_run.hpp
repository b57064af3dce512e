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
  SceneFile file;
  std::vector<ParticleFile> particles;  // in order of time
  std::vector<int> numbers;             // of these files, as in their names
};

/// Throws UsageError if the folder is no run or has no particles.
SavedRun open_saved_run(const std::filesystem::path& folder);

/// Names of the files between the first and the last one that are missing, also from 0: "particles_00003.vtp".
std::vector<std::string> missing_files(const SavedRun& run);

struct ColoredParticles {
  int dim = 2;
  double time = 0;                         // s
  std::vector<double> x, diameter, value;  // as in FrameView

  FrameView view() const;
};

/// Colours particles as `drawing` requires. `origins`: initial particles of the run. Throws UsageError for a field that
/// was not saved.
ColoredParticles read_colored(const ParticleFile& file, const Drawing& drawing, const Origins& origins);

}  // namespace taut::cli
