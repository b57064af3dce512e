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

/// Output folder of a run; cli/COMMANDS.md describes its files.
class RunFolder {
 public:
  /// `named`: the user has named this folder, so that it may be a link.
  explicit RunFolder(std::filesystem::path path, bool named = true) : path_(std::move(path)), named_(named) {}

  /// Throws UsageError for files that are not from a run. Changes nothing.
  void check() const;
  /// Whether the folder contains a run whose run.json is unreadable: it contains scene and history, or its run.json
  /// begins as a record does and all its files are files of runs.
  bool is_damaged() const;
  /// Creates the folder, and `record` as run.json before any other file: it marks the folder as a run. Throws
  /// OutputError.
  void claim(std::string_view record) const;
  /// Removes an earlier run's results. Throws OutputError.
  void clear() const;
  /// Throw UsageError if one of the first `number` files is missing: a continued run would be called complete.
  void check_frames(int number) const;
  void check_particle_files(int number) const;
  /// Remove all but the first `number` files. Throw OutputError.
  void keep_frames(int number) const;
  void keep_particle_files(int number) const;
  /// Removes the checkpoint, complete or temporary. Throws OutputError.
  void clear_checkpoint() const;
  /// Removes the frames, and look.json and difference.png made from them. Throws OutputError.
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
  std::filesystem::path checkpoint() const { return path_ / "checkpoint.bin"; }
  /// Range and view of the frames, if they are to become a baseline.
  std::filesystem::path look() const { return path_ / "look.json"; }
  std::filesystem::path difference() const { return path_ / "difference.png"; }

 private:
  bool holds_only(const std::set<std::string>& names) const;

  std::filesystem::path path_;
  bool named_;
};

/// Finds the run folder that contains `path`, if any. It must be locked before `path` is written.
std::optional<std::filesystem::path> run_around(const std::filesystem::path& path);
/// Locks the run folder that contains `path`, if any, else returns nullptr. Throws like FolderLock.
std::unique_ptr<const FolderLock> lock_around(const std::filesystem::path& path, std::string_view command);

}  // namespace taut::cli
