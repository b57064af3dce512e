#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "cli/drawing/frames.hpp"
#include "cli/system/folder_lock.hpp"

namespace taut::cli {

/// Where a run leaves its output; cli/COMMANDS.md says what each file holds.
class RunFolder {
 public:
  /// `named`: the user has named this folder, so that it may be a link.
  explicit RunFolder(std::filesystem::path path, bool named = true) : path_(std::move(path)), named_(named) {}

  /// Throws UsageError when the folder holds something that no run of taut left there. Touches nothing.
  void check() const;
  /// True for a run with an unreadable run.json: a disk was full, has lost it, or somebody has overwritten it. The
  /// scene and the history identify a run; without them, the beginning of run.json does if all files are of a run.
  bool is_damaged() const;
  /// Creates the folder, and `record` as its run.json first of all, so that it is recognised at any time.
  /// Throws OutputError.
  void claim(std::string_view record) const;
  /// Removes what an earlier run has shown, and makes room for the next one. Throws OutputError.
  void clear() const;
  /// Remove all frames, or all particle files, but the first ones, which a run that goes on has written
  /// already. Throw OutputError.
  void keep_frames(int number) const;
  void keep_particle_files(int number) const;
  /// Removes the checkpoint, whole or in the making. Throws OutputError.
  void clear_checkpoint() const;
  /// Removes what shows the frames that there are, before others are drawn. Throws OutputError.
  void clear_frames() const;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path frames() const { return path_ / "frames"; }
  std::filesystem::path frame(int number) const { return frames() / frame_name(number); }
  std::filesystem::path particles() const { return path_ / "particles"; }
  std::filesystem::path particle_file(int number) const;
  /// Times and names of the particle files, for ParaView.
  std::filesystem::path particle_index() const { return particles() / "particles.pvd"; }
  std::filesystem::path history() const { return path_ / "history.csv"; }
  std::filesystem::path lines() const { return path_ / "lines.csv"; }
  std::filesystem::path scene() const { return path_ / "scene.toml"; }
  std::filesystem::path record() const { return path_ / "run.json"; }
  /// To go on from, while the run is not finished.
  std::filesystem::path checkpoint() const { return path_ / "checkpoint.bin"; }
  /// Where the frames differ from a baseline that they were compared with.
  std::filesystem::path difference() const { return path_ / "difference.png"; }

 private:
  bool holds_only(const std::set<std::string>& names) const;

  std::filesystem::path path_;
  bool named_;
};

/// The folder to lock before `path` is written: that of the run which it lies in; else none.
std::optional<std::filesystem::path> run_around(const std::filesystem::path& path);
/// While something is written that may lie in the folder of a run; else nothing. Throws what FolderLock throws.
std::unique_ptr<const FolderLock> lock_around(const std::filesystem::path& path, std::string_view command);

}  // namespace taut::cli
