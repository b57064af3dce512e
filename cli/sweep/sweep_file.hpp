#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/scene/toml_cursor.hpp"
#include "cli/study/study.hpp"
#include "cli/sweep/grid.hpp"

namespace taut::cli {

struct SweepFile {
  std::filesystem::path path;
  std::string title, scene;
  std::vector<Setting> set;
  std::vector<GridRow> rows;
  int repeat = 1;
  StudyPictures pictures;
};

/// Reads lines NAME = VALUE. Throws SceneError.
std::vector<Setting> read_settings(TomlCursor& table);
/// `own` has priority.
std::vector<Setting> merged(const std::vector<Setting>& common, const std::vector<Setting>& own);
/// Relative to the folder of `file`, or else from find_scene(). Throws SceneError.
std::string find_scene_of(TomlCursor& table, const std::filesystem::path& file);

/// Throws SceneError unless the file is TOML.
bool is_sweep_file(const std::filesystem::path& path);
/// Throws SceneError, and UsageError for a scene file. Does not check whether names and values fit the scene.
SweepFile read_sweep(const std::filesystem::path& path);

}  // namespace taut::cli
