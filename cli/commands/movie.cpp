#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <optional>
#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/run/folder.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/run/redraw.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/external_program.hpp"
#include "cli/system/interrupts.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct MovieArguments {
  std::string frames, out;
  double fps = 30;
  bool orbit = false;
};

/// Throws UsageError if a frame is not a regular file, or is missing, at which ffmpeg would stop silently.
int count_frames(const fs::path& folder) {
  int whole = 0;
  std::error_code error;
  while (fs::is_regular_file(folder / frame_name(whole), error)) ++whole;
  const std::string missing = frame_name(whole);
  if (fs::exists(folder / missing, error))
    throw UsageError(fmt::format("{} in {} is not a regular file; draw all frames again with `taut render`",
                                 missing, folder.string()));
  const auto is_later_frame = [&](const std::string& name) {
    return name.size() == missing.size() && name.starts_with("frame_") && name > missing;
  };
  if (std::ranges::any_of(picture_names(folder), is_later_frame))
    throw UsageError(
        fmt::format("{} is missing in {}, but later frames exist; draw all frames again with `taut render`",
                    missing, folder.string()));
  if (whole == 0)
    throw UsageError(
        fmt::format("there are no frames ({}, ...) in {}; draw them with `taut run` or `taut render`",
                    missing, folder.string()));
  return whole;
}

class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "taut-orbit-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw OutputError(name, "the folder cannot be created");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Returns false if interrupted.
bool draw_orbit(const fs::path& folder, const fs::path& frames, std::ostream& err) {
  SavedRun run = open_saved_run(folder);
  run.file.drawing.orbit = true;
  std::iota(run.numbers.begin(), run.numbers.end(), 0);
  check_redrawing(run);
  Progress progress(err, progress_style(err, false));
  return redraw(run, frames, 0, progress).all;
}

/// H.264 needs even sides.
std::vector<std::string> encoding(const std::string& extension) {
  if (extension == ".gif")
    return {"-vf", "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=none"};
  return {"-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
          "-c:v",      "libx264",
          "-crf",      "18",
          "-preset",   "veryfast",
          "-pix_fmt",  "yuv420p",
          "-movflags", "+faststart"};
}

std::vector<std::string> arguments_of(const MovieArguments& options, const fs::path& movie) {
  std::vector<std::string> arguments{"-nostdin",   "-hide_banner",     "-loglevel", "error",         "-y",
                                     "-framerate", exact(options.fps), "-i",        "frame_%05d.png"};
  const std::vector<std::string> rest = encoding(movie.extension().string());
  arguments.insert(arguments.end(), rest.begin(), rest.end());
  // `file:` keeps ffmpeg from reading a name with ':' as a protocol
  arguments.push_back("file:" + movie.string());
  return arguments;
}

int encode(const MovieArguments& options, const fs::path& folder) {
  make_folder_of(options.out);
  const auto arguments = [&](const fs::path& part) { return arguments_of(options, part); };
  return make_file({"ffmpeg", "movies", "ffmpeg"}, arguments, folder, options.out);
}

int movie(const MovieArguments& options, Streams streams) {
  const std::string extension = fs::path(options.out).extension().string();
  if (extension != ".mp4" && extension != ".gif")
    throw UsageError(fmt::format("--out is '{}'; it must end in .mp4 or .gif", options.out));
  std::optional<ScratchFolder> orbit;
  if (options.orbit && !draw_orbit(options.frames, orbit.emplace().path(), streams.err))
    return Interrupts::exit_code();
  const fs::path folder = orbit ? orbit->path() : frames_of(options.frames);
  const int count = count_frames(folder);
  const int code = encode(options, folder);
  if (code == exit_fine)
    streams.out << "movie  " << options.out << " (" << count << " frames, " << brief(count / options.fps)
                << " s)\n";
  return code;
}

}  // namespace

std::function<int(Streams)> declare_movie(Options& command) {
  auto options = std::make_shared<MovieArguments>();
  command.add_argument("DIR", options->frames, "a run folder, or a folder of frames").required();
  command.add("--out", "movie.mp4|movie.gif", options->out, "movie to write").required();
  command.add("--fps", "N", options->fps, "frames per second; default: 30").check(positive_number);
  command.add_flag("--orbit", options->orbit,
                   "3D runs with saved particles: redraw the frames while the camera circles the scene once");
  return [options](Streams streams) { return movie(*options, streams); };
}

}  // namespace taut::cli
