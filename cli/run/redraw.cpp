#include "cli/run/redraw.hpp"

#include <fmt/core.h>

#include "cli/drawing/frames.hpp"
#include "cli/system/interrupts.hpp"
#include "engine/core/machine.hpp"
#include "engine/error.hpp"

namespace taut::cli {

void check_redrawing(const SavedRun& run) {
  const Drawing& drawing = run.file.drawing;
  const Origins origins = origins_of(run.file.scene);
  read_colored(run.particles.front(), drawing, origins);
  const Staging staging(drawing, origins);
  if (drawing.orbit && run.file.scene.dim == 2)
    throw UsageError("--orbit needs a scene in 3D; this scene has dim = 2");
}

Redrawn redraw(const SavedRun& run, const std::filesystem::path& folder, int threads, Progress& progress) {
  const Scene& scene = run.file.scene;
  Seconds seconds;
  if (threads == 0) threads = cores();
  const Origins origins = origins_of(scene);
  Frames frames(run.file.drawing, origins, folder, {scene.title, run.file.settings.method, scene.until},
                threads, seconds);
  frames.number_files(run.numbers);
  const Interrupts interrupts;
  const double count = static_cast<double>(run.particles.size());
  const auto go_on = [&](int drawn) {
    progress.show(drawn / count, "frame " + std::to_string(drawn + 1));
    return !interrupts.interrupted();
  };
  const auto add_all = [&] {
    for (const ParticleFile& file : run.particles) {
      if (!go_on(frames.written())) return false;
      frames.add(read_colored(file, run.file.drawing, origins).view());
    }
    return true;
  };
  progress.begin(fmt::format("drawing {} frames", run.particles.size()));
  const bool all = add_all() && frames.draw_kept(go_on);
  frames.finish();
  progress.end(std::to_string(frames.written()) + " frames");
  return {frames.written(), all, frames.cut_texts()};
}

}  // namespace taut::cli
