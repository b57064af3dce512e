#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "cli/drawing/frames.hpp"
#include "cli/formats/particle_format.hpp"
#include "cli/system/folder_lock.hpp"

namespace taut::cli {

/// Files: cli/COMMANDS.md.
class RunFolder {
 public:
  /// `named`: named by the user, may be a link.
  explicit RunFolder(std::filesystem::path path, bool named = true) : path_(std::move(path)), named_(named) {}

  /// Throws UsageError if a run must not write here.
  void check() const;
  /// Whether this is a run with an invalid run.json.
  bool is_damaged() const;
  /// Writes run.json. Throws OutputError.
  void claim(std::string_view record) const;
  /// Removes frames, particles, history and lines. Throws OutputError.
  void clear() const;
  /// Throw UsageError if one of the first `number` files is missing.
  void check_frames(int number) const;
  void check_particle_files(int number, ParticleFormat format) const;
  /// Remove files after the first `number`. Throw OutputError.
  void keep_frames(int number) const;
  void keep_particle_files(int number, ParticleFormat format) const;
  /// Removes complete and temporary checkpoints. Throws OutputError.
  void clear_checkpoint() const;
  /// Also removes look.json and difference.png. Throws OutputError.
  void clear_frames() const;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path frames() const { return path_ / "frames"; }
  std::filesystem::path frame(int number) const { return frames() / frame_name(number); }
  std::filesystem::path particles() const { return path_ / "particles"; }
  std::filesystem::path particle_file(int number, ParticleFormat format = ParticleFormat::vtp) const;
  /// Index for ParaView.
  std::filesystem::path particle_index() const { return particles() / "particles.pvd"; }
  std::filesystem::path particle_entry(ParticleFormat format) const {
    return format == ParticleFormat::vtp ? particle_index() : particle_file(0, format);
  }
  std::filesystem::path history() const { return path_ / "history.csv"; }
  std::filesystem::path lines() const { return path_ / "lines.csv"; }
  std::filesystem::path scene() const { return path_ / "scene.toml"; }
  std::filesystem::path record() const { return path_ / "run.json"; }
  std::filesystem::path checkpoint() const { return path_ / "checkpoint.bin"; }
  std::filesystem::path look() const { return path_ / "look.json"; }
  std::filesystem::path difference() const { return path_ / "difference.png"; }

 private:
  bool holds_only(const std::set<std::string>& names) const;

  std::filesystem::path path_;
  bool named_;
};

std::optional<std::filesystem::path> run_around(const std::filesystem::path& path);
/// nullptr outside run folders. Throws like FolderLock.
std::unique_ptr<const FolderLock> lock_around(const std::filesystem::path& path, std::string_view command);

}  // namespace taut::cli
