#pragma once

#include <filesystem>
#include <optional>

#include "cli/drawing/kept_look.hpp"
#include "cli/run/folder.hpp"

namespace taut::cli {

/// Folder of frames to compare with, and of look.json, their range and view. Baselines of older versions have no
/// look.json.
class Baseline {
 public:
  explicit Baseline(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  bool exists() const;
  /// Returns nullopt for a baseline without look. Throws UsageError for a damaged file.
  std::optional<KeptLook> look() const;
  /// Throws UsageError if the path is not a folder, or inside the run folder, which the run replaces; with `update`
  /// also if it contains files that are not of a baseline.
  void check(const std::filesystem::path& run, bool update) const;
  /// Copies the run's frames and look.json into a new folder, which then replaces the old one. Returns the number of
  /// frames. Throws OutputError and keeps the old folder then.
  std::size_t replace_by(const RunFolder& run) const;

 private:
  std::filesystem::path path_;
};

/// Resolves links, removes a final slash.
std::filesystem::path plain_path(const std::filesystem::path& path);

}  // namespace taut::cli
