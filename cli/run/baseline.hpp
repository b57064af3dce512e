#pragma once

#include <filesystem>
#include <optional>

#include "cli/drawing/kept_look.hpp"
#include "cli/run/folder.hpp"

namespace taut::cli {

/// Reference frames and their look.json.
class Baseline {
 public:
  explicit Baseline(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  bool exists() const;
  /// nullopt without look.json. Throws UsageError for a damaged file.
  std::optional<KeptLook> look() const;
  /// Throws UsageError for an unsuitable path. With `update`, the folder must contain only a baseline.
  void check(const std::filesystem::path& run, bool update) const;
  /// Replaces the folder by copies of frames and look.json. Returns the number of frames. Throws OutputError.
  std::size_t replace_by(const RunFolder& run) const;

 private:
  std::filesystem::path path_;
};

/// Absolute path without links and final slash.
std::filesystem::path plain_path(const std::filesystem::path& path);

}  // namespace taut::cli
