#include "cli/scene/shipped.hpp"

#include <algorithm>

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

fs::path studies_folder() { return scenes_folder() / "studies"; }

/// Of the .toml files of a folder, sorted.
std::vector<std::string> names_in_folder(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace

fs::path scenes_folder() { return TAUT_SCENES_FOLDER; }

std::vector<std::string> scene_names() { return names_in_folder(scenes_folder()); }

fs::path find_scene(const std::string& scene) {
  // a run's folder often has the name of its scene: a folder is no scene while there is one of that name
  std::error_code error;
  const bool exists = fs::exists(scene, error);
  if (exists && !fs::is_directory(scene, error)) return scene;
  const std::vector<std::string> names = scene_names();
  if (std::ranges::find(names, scene) != names.end()) return scenes_folder() / (scene + ".toml");
  if (exists) return scene;
  throw UsageError("there is no scene file '" + scene + "' and no scene of that name" +
                   did_you_mean(scene, names) + "; scenes: " + join(names));
}

std::vector<std::string> study_names() { return names_in_folder(studies_folder()); }

fs::path find_sweep(const std::string& sweep) {
  std::error_code error;
  if (fs::is_regular_file(sweep, error)) return sweep;
  const std::vector<std::string> names = study_names();
  if (std::ranges::find(names, sweep) != names.end()) return studies_folder() / (sweep + ".toml");
  throw UsageError("there is no sweep file '" + sweep + "' and no study of that name" +
                   did_you_mean(sweep, names) + "; studies: " + join(names) +
                   ". For a sweep of a scene add --grid NAME=VALUES");
}

}  // namespace taut::cli
