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

/// Run folder; cli/COMMANDS.md describes its files.
class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// Throws UsageError if the folder contains files that are not from a run. Changes nothing.
  void check() const;
  /// Whether run.json is unreadable. A run is recognised by scene and history, else by the beginning of run.json if
  /// all file names are those of a run.
  bool is_damaged() const;
  /// Creates the folder, with `record` as run.json first, which marks it as a run. Throws OutputError.
  void claim(std::string_view record) const;
  /// Removes the results of an earlier run. Throws OutputError.
  void clear() const;
  /// Remove all but the first `number` files, for a continued run. Throw OutputError.
  void keep_frames(int number) const;
  void keep_particle_files(int number) const;
  /// Throws OutputError.
  void clear_checkpoint() const;
  /// Also removes difference.png. Throws OutputError.
  void clear_frames() const;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path frames() const { return path_ / "frames"; }
  std::filesystem::path frame(int number) const { return frames() / frame_name(number); }
  std::filesystem::path particles() const { return path_ / "particles"; }
  std::filesystem::path particle_file(int number) const;
  /// Index for ParaView.
  std::filesystem::path particle_index() const { return particles() / "particles.pvd"; }
  std::filesystem::path history() const { return path_ / "history.csv"; }
  std::filesystem::path lines() const { return path_ / "lines.csv"; }
  std::filesystem::path scene() const { return path_ / "scene.toml"; }
  std::filesystem::path record() const { return path_ / "run.json"; }
  std::filesystem::path checkpoint() const { return path_ / "checkpoint.bin"; }
  /// Picture of the differences from a baseline.
  std::filesystem::path difference() const { return path_ / "difference.png"; }

 private:
  bool holds_only(const std::set<std::string>& names) const;

  std::filesystem::path path_;
};

/// The run folder that contains `path`, if any.
std::optional<std::filesystem::path> run_around(const std::filesystem::path& path);
/// Locks that folder while `path` is written; nullptr if there is none. Throws as FolderLock.
std::unique_ptr<const FolderLock> lock_around(const std::filesystem::path& path, std::string_view command);

}  // namespace taut::cli
