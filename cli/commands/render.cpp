#include <filesystem>
#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/drawing/frames.hpp"
#include "cli/drawing/options.hpp"
#include "cli/run/plan.hpp"
#include "cli/run/redraw.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/folder_lock.hpp"
#include "cli/system/interrupts.hpp"
#include "cli/system/progress.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct RenderArguments : DrawingOptions {
  std::string run;
  std::optional<std::string> out;
  bool orbit = false;
  int threads = 0;  // 0: all cores
  bool quiet = false;
};

bool is_lock(const fs::path& file) { return file.filename() == run_lock_name; }

void check_for_frames(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw UsageError("'" + folder.string() + "' is not a folder");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (!is_frame(entry.path()) && !is_lock(entry.path()))
      throw UsageError("'" + folder.string() + "' contains " + entry.path().filename().string() +
                       ", which is not a frame; name another folder with --out");
}

void clear_for_frames(const fs::path& folder) {
  make_folders(folder);
  check_for_frames(folder);  // the folder may have changed
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (!is_lock(entry.path())) fs::remove(entry.path());
}

fs::path prepare(const RenderArguments& options, SavedRun& run) {
  if (options.out) {
    clear_for_frames(*options.out);
    return *options.out;
  }
  run.folder.check();
  const std::string scene = resolved_text(run.file, run.folder.path());
  // a continued run would draw its next frames differently
  if (fs::exists(run.folder.checkpoint()) && read_whole(run.folder.scene()) != scene)
    throw UsageError("the run in '" + run.folder.path().string() +
                     "' has a checkpoint, so its frames cannot change; name another folder with --out, "
                     "finish the run with `taut run --resume`, or remove checkpoint.bin of a finished run");
  run.folder.clear_frames();
  write_atomically(run.folder.scene(), scene, Durability::on_disk);
  return run.folder.frames();
}

fs::path folder_to_lock(const RenderArguments& options) {
  if (!options.out) return options.run;
  check_for_frames(*options.out);
  return run_around(*options.out).value_or(*options.out);
}

void warn_about_missing_files(const SavedRun& run, std::ostream& err) {
  constexpr std::size_t shown = 3;
  std::vector<std::string> names = missing_files(run);
  if (names.empty()) return;
  const std::string more = names.size() > shown ? fmt::format(" and {} more", names.size() - shown) : "";
  names.resize(std::min(names.size(), shown));
  err << "taut: " << join(names) << more << " in '" << run.folder.particles().string()
      << "' are missing, and so are their frames; the other frames keep their numbers\n";
}

int render(const RenderArguments& options, Streams streams) {
  check_threads(options.threads);
  SavedRun run = open_saved_run(options.run);  // before the lock creates a file
  const FolderLock lock(folder_to_lock(options), FolderLock::Of::run, "taut render", streams.err);
  run = open_saved_run(options.run);  // the run may have changed
  run.file.drawing = with_options(run.file.drawing, options);
  apply_scene(run.file.drawing, run.file);
  run.file.drawing.orbit = options.orbit;
  check_redrawing(run);  // must precede the removal of frames
  const fs::path folder = prepare(options, run);
  Progress progress(streams.err, progress_style(streams.err, options.quiet));
  const auto [frames, all, cut_texts] = redraw(run, folder, options.threads, progress);
  warn_about_missing_files(run, streams.err);
  streams.err << remark_on_texts(cut_texts);
  streams.out << "frames  " << folder.string() << " (" << frames << ")\n";
  return all ? exit_fine : Interrupts::exit_code();
}

}  // namespace

std::function<int(Streams)> declare_render(Options& command) {
  auto options = std::make_shared<RenderArguments>();
  command.add_argument("DIR", options->run, "a run folder with particles (`taut run --save-particles`)")
      .required();
  declare_drawing_options(command, *options);
  command.add("--out", "DIR", options->out, "folder for the frames; default: replace the frames of the run");
  command.add_flag("--orbit", options->orbit, "3D: the camera circles the scene once");
  command.add("--threads", "N", options->threads, "number of frames drawn at once; default: all cores")
      .check(positive_whole_number);
  command.add_flag("--quiet", options->quiet, "print no progress on stderr");
  return [options](Streams streams) { return render(*options, streams); };
}

}  // namespace taut::cli
