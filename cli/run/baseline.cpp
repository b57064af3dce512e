#include "cli/run/baseline.hpp"

#include <algorithm>
#include <vector>

#include "cli/drawing/frames.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/system/atomic_file.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {

fs::path plain_path(const fs::path& path) {
  return (fs::weakly_canonical(fs::absolute(path)) / "").parent_path();
}

bool Baseline::exists() const { return !picture_names(path_).empty(); }

std::optional<KeptLook> Baseline::look() const { return read_look(RunFolder(path_).look()); }

void Baseline::check(const fs::path& run, bool update) const {
  const fs::path baseline = plain_path(path_), run_folder = plain_path(run);
  if (std::ranges::mismatch(run_folder, baseline).in1 == run_folder.end())
    throw UsageError("the baseline is inside the run folder " + run.string() +
                     ", which the run replaces; name another run folder with --out");
  if (fs::exists(baseline) && !fs::is_directory(baseline))
    throw UsageError("the baseline '" + path_.string() + "' is not a folder");
  if (!update || !fs::exists(baseline)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(baseline))
    if (!is_frame(entry.path()) && entry.path().filename() != RunFolder(path_).look().filename())
      throw UsageError("'" + path_.string() + "' contains " + entry.path().filename().string() +
                       ", which is not a frame and would be lost; name another folder with --baseline");
}

std::size_t Baseline::replace_by(const RunFolder& run) const {
  std::vector<fs::path> files{run.look()};
  for (const std::string& name : picture_names(run.frames())) files.push_back(run.frames() / name);
  write_whole_folder(path_, files);
  return files.size() - 1;
}

}  // namespace taut::cli
