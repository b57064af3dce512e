#pragma once

#include <filesystem>
#include <optional>

#include "cli/drawing/kept_look.hpp"
#include "cli/run/folder.hpp"

namespace taut::cli {

/// Frames to compare with, and look.json, which old baselines lack.
class Baseline {
 public:
  explicit Baseline(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  bool exists() const;
  /// nullopt without look.json. Throws UsageError for a damaged file.
  std::optional<KeptLook> look() const;
  /// Throws UsageError if the path is no folder, or inside the run folder; with `update` also if it contains other
  /// files.
  void check(const std::filesystem::path& run, bool update) const;
  /// Replaces the folder by copies of frames and look.json; returns the number of frames. After an OutputError the
  /// folder is the old or the new one.
  std::size_t replace_by(const RunFolder& run) const;

 private:
  std::filesystem::path path_;
};

/// Resolves links and removes a final slash.
std::filesystem::path plain_path(const std::filesystem::path& path);

}  // namespace taut::cli
