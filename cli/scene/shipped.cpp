#include "cli/scene/shipped.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string_view>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

constexpr const char* gallery = "gallery/";
constexpr const char* studies = "studies/";
constexpr const char* papers = "papers/";
constexpr const char* suites = "suites/";

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::vector<fs::path> folders_of_user() {
  std::vector<fs::path> folders;
  const char* given = std::getenv("TAUT_SCENES");
  std::string_view rest = given ? given : "";
  while (!rest.empty()) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
    if (folder.empty()) continue;
    if (!is_folder(folder))
      throw UsageError(fmt::format(
          "TAUT_SCENES contains the folder '{}', which does not exist; correct or unset it", folder));
    folders.emplace_back(fs::absolute(folder));
  }
  return folders;
}

/// A build links `scenes` beside the program.
std::vector<fs::path> places_of_shipped() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {TAUT_INSTALLED_SCENES};
  return {program.parent_path() / "scenes", program.parent_path().parent_path() / "share/taut/scenes"};
}

std::set<std::string> names_below(const std::string& folder) {
  std::set<std::string> names;
  for (const fs::path& scenes : scene_folders()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(scenes / folder, error))
      if (entry.path().extension() == ".toml" && !entry.is_fifo(error))
        names.insert(entry.path().stem().string());
  }
  return names;
}

void refuse_no_folder() {
  if (!scene_folders().empty()) return;
  std::string message = "cannot find the scenes that come with taut; searched in";
  for (const fs::path& place : places_of_shipped()) message += "\n  " + place.string();
  throw UsageError(message + "\nSet the environment variable TAUT_SCENES to the folder that contains them");
}

fs::path file_of(const std::string& name) {
  std::error_code error;
  for (const fs::path& scenes : scene_folders())
    if (fs::path file = scenes / (name + ".toml"); fs::exists(file, error)) return file;
  throw UsageError(fmt::format("'{}' has just been removed from its folder", name));
}

}  // namespace

std::vector<fs::path> scene_folders() {
  std::vector<fs::path> folders = folders_of_user();
  const std::vector<fs::path> places = places_of_shipped();
  const auto shipped = std::ranges::find_if(places, is_folder);
  if (shipped != places.end()) folders.push_back(*shipped);
  return folders;
}

std::vector<std::string> scene_names() {
  refuse_no_folder();
  const std::set<std::string> first = names_below("");
  std::vector<std::string> names(first.begin(), first.end());
  for (const std::string& name : names_below(gallery)) names.push_back(gallery + name);
  return names;
}

fs::path find_scene(const std::string& scene) {
  std::error_code error;
  const bool exists = fs::exists(scene, error);
  if (exists && !fs::is_directory(scene, error)) return scene;
  if (!exists && scene.ends_with(".toml") && scene_folders().empty())
    throw UsageError(fmt::format("there is no scene file '{}'", scene));
  const std::vector<std::string> names = scene_names();
  if (std::ranges::find(names, scene) != names.end()) return file_of(scene);
  if (exists) return scene;
  if (fs::is_regular_file(scene + ".toml", error))
    throw UsageError(
        fmt::format("there is no scene with the name '{0}'; did you mean the file '{0}.toml'?", scene));
  throw UsageError(
      fmt::format("there is no scene file '{}' and no scene of that name{}; `taut list scenes` shows all",
                  scene, known_names(scene, names)));
}

std::vector<std::string> study_names() {
  refuse_no_folder();
  const std::set<std::string> names = names_below(studies);
  return {names.begin(), names.end()};
}

fs::path find_sweep(const std::string& sweep) {
  std::error_code error;
  if (fs::is_regular_file(sweep, error)) return sweep;
  const std::vector<std::string> names = study_names();
  if (std::ranges::find(names, sweep) != names.end()) return file_of(studies + sweep);
  throw UsageError(fmt::format(
      "there is no sweep file '{}' and no study of that name{}; to sweep a scene, add --grid NAME=VALUES",
      sweep, known_names(sweep, names)));
}

std::vector<std::string> suite_names() {
  refuse_no_folder();
  const std::set<std::string> names = names_below(suites);
  return {names.begin(), names.end()};
}

std::optional<fs::path> shipped_suite(const std::string& name) {
  const std::set<std::string> names = names_below(suites);
  return names.contains(name) ? std::optional(file_of(suites + name)) : std::nullopt;
}

std::vector<std::string> paper_names() {
  refuse_no_folder();
  const std::set<std::string> names = names_below(papers);
  return {names.begin(), names.end()};
}

fs::path find_paper(const std::string& paper) {
  std::error_code error;
  if (fs::is_regular_file(paper, error)) return paper;
  const std::vector<std::string> names = paper_names();
  if (std::ranges::find(names, paper) != names.end()) return file_of(papers + paper);
  throw UsageError(fmt::format("there is no claim file '{}' and no paper of that name{}", paper,
                               known_names(paper, names)));
}

}  // namespace taut::cli
