#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/drawing/keys.hpp"
#include "cli/scene/scene_file.hpp"
#include "render/image/image_difference.hpp"

namespace taut::cli {

/// A scene with settings, whose frames are compared with a baseline.
struct SuiteEntry {
  std::string name;
  FilePlace place;
  std::string scene;
  std::string differs_from;  // of a control: entry from whose baseline it must differ
  std::vector<Setting> settings;
  DrawingValues drawing;
  std::optional<double> warn, fail;  // ΔE*ab

  bool is_control() const { return !differs_from.empty(); }
  /// Entry with the baseline.
  const std::string& owner() const { return is_control() ? differs_from : name; }
};

/// Entries inherit keys of the suite, and controls inherit keys of `differs_from`.
struct SuiteFile {
  std::filesystem::path path, baselines;
  std::string title;
  std::vector<SuiteEntry> entries;
};

/// Throws SceneError unless the file is TOML.
bool is_suite_file(const std::filesystem::path& path);
/// Throws SceneError. Does not check whether settings and drawing fit the scenes.
SuiteFile read_suite(const std::filesystem::path& path);

}  // namespace taut::cli
