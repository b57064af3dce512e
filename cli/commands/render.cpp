#include <filesystem>
#include <ostream>

#include <CLI/CLI.hpp>

#include "cli/command_line/command.hpp"
#include "cli/drawing/frames.hpp"
#include "cli/drawing/options.hpp"
#include "cli/run/saved_run.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/interrupts.hpp"
#include "cli/system/progress.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct Options : DrawingOptions {
  std::string run;
  std::optional<std::string> out;
  bool quiet = false;
};

/// A folder for frames alone: they would be lost among other files, and other files among them.
void clear_for_frames(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string(), "the folder cannot be made: " + error.message());
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (!is_frame(entry.path()))
      throw UsageError("'" + folder.string() + "' holds " + entry.path().filename().string() +
                       ", which is no frame; name another folder with --out");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) fs::remove(entry.path());
}

/// Makes room for the frames; in the run's own folder, scene.toml says from now on how they are drawn.
fs::path prepare(const Options& options, SavedRun& run) {
  if (options.out) {
    clear_for_frames(*options.out);
    return *options.out;
  }
  run.folder.clear_frames();
  write_atomically(run.folder.scene(), resolved_text(run.file, run.folder.path()));
  return run.folder.frames();
}

/// False if it was interrupted.
bool draw_all(const SavedRun& run, Frames& frames, Progress& progress) {
  const Interrupts interrupts;
  const double count = static_cast<double>(run.particles.size());
  const auto go_on = [&](int drawn) {
    progress.show(drawn / count, "frame " + std::to_string(drawn + 1));
    return !interrupts.asked();
  };
  progress.begin("drawing " + std::to_string(run.particles.size()) + " frames");
  for (const ParticleFile& file : run.particles) {
    if (!go_on(frames.written())) return false;
    frames.add(read_colored(file, *run.file.drawing.field, run.file.scene.dim).view());
  }
  return frames.draw_kept(go_on);
}

int render(const Options& options, Streams streams) {
  SavedRun run = open_saved_run(options.run);
  run.file.drawing = with_options(run.file.drawing, options);
  suit(run.file.drawing, run.file);
  const Drawing& drawing = run.file.drawing;
  read_colored(run.particles.front(), *drawing.field,
               run.file.scene.dim);  // fails before anything is removed
  const Scene& scene = run.file.scene;
  Origins origins = origins_of(scene);
  Staging(drawing, origins);  // as does this
  const fs::path folder = prepare(options, run);
  double drawing_time = 0, writing_time = 0;  // nobody asks for them
  Frames frames(drawing, std::move(origins), folder, {scene.title, run.file.settings.method, scene.until},
                drawing_time, writing_time);
  Progress progress(streams.err, progress_style(streams.err, options.quiet));
  const bool all = draw_all(run, frames, progress);
  progress.end(std::to_string(frames.written()) + " frames");
  streams.out << "frames  " << folder.string() << " (" << frames.written() << ")\n";
  return all ? exit_fine : exit_interrupted;
}

}  // namespace

std::function<int(Streams)> declare_render(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("DIR", options->run, "a run folder with particles (`taut run --save-particles`)")
      ->option_text(" ")
      ->required();
  declare_drawing_options(app, *options);
  app.add_option("--out", options->out, "a folder for the frames; default: those of the run are replaced")
      ->option_text("DIR");
  app.add_flag("--quiet", options->quiet, "no progress on stderr");
  return [options](Streams streams) { return render(*options, streams); };
}

}  // namespace taut::cli
