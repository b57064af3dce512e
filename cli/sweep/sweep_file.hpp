#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/study/study.hpp"
#include "cli/sweep/grid.hpp"

namespace taut::cli {

/// See cli/COMMANDS.md, scenes/LANGUAGE.md.
struct SweepFile {
  std::filesystem::path path;
  std::string title, scene;
  std::vector<Setting> set;
  std::vector<GridRow> rows;
  StudyPictures pictures;
};

/// Whether it is a sweep, not a scene. Throws SceneError unless it is TOML.
bool is_sweep_file(const std::filesystem::path& path);
/// Throws SceneError with its place. Does not check names and values against the scene.
SweepFile read_sweep(const std::filesystem::path& path);

}  // namespace taut::cli
