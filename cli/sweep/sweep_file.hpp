#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/study/study.hpp"
#include "cli/sweep/grid.hpp"

namespace taut::cli {

/// A sweep file as read:
///
///     title = "How fast may the rings be?"    optional; else the scene's
///     scene = "colliding-rings"               a name, or a path seen from this file
///     set = { until = 0.01 }                  optional: for every run, as with --set
///     [grid]                                  every combination of
///     v0 = "0.02:0.16:0.02"                   lo:hi:step, or a list: "0.02, 0.04", [0.02, 0.04]
///     method = ["og", "enog"]
///
/// or, instead of [grid], one [[row]] for each run:
///
///     [[row]]
///     v0 = 0.02
///     "method.zeta" = 3.5
///
/// A study also says what is drawn from the results: see StudyPictures.
struct SweepFile {
  std::filesystem::path path;
  std::string title, scene;
  std::vector<Setting> set;
  std::vector<GridRow> rows;
  StudyPictures pictures;
};

/// Whether the file is a sweep rather than a scene. Throws SceneError for one that is no TOML.
bool is_sweep_file(const std::filesystem::path& path);
/// Throws SceneError with file, line and column. What the names and values mean to the scene is not looked
/// at.
SweepFile read_sweep(const std::filesystem::path& path);

}  // namespace taut::cli
