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
  std::string scene;  // path
  std::string
      differs_from;  // a control: name of the entry whose baseline its frames must not equal; else empty
  std::vector<Setting> settings;
  DrawingValues drawing;
  std::optional<double> warn, fail;  // ΔE*ab; see the keys in scenes/LANGUAGE.md

  bool is_control() const { return !differs_from.empty(); }
  /// The entry that has the baseline: itself, or that of `differs_from`.
  const std::string& owner() const { return is_control() ? differs_from : name; }
};

/// Contents of a suite file; see cli/COMMANDS.md and scenes/LANGUAGE.md. Keys of suite and controlled entry are
/// merged into each entry.
struct SuiteFile {
  std::filesystem::path path, baselines;
  std::string title;
  std::vector<SuiteEntry> entries;  // at least one
};

/// Whether the file is a suite, not a scene. Throws SceneError unless it is TOML.
bool is_suite_file(const std::filesystem::path& path);
/// Throws SceneError with file, line and column. Does not check settings and drawing against the scenes.
SuiteFile read_suite(const std::filesystem::path& path);

}  // namespace taut::cli
