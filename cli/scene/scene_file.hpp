#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/drawing/drawing.hpp"
#include "cli/scene/toml_tree.hpp"
#include "engine/error.hpp"
#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"

namespace taut::cli {

struct Parameter {
  std::string name;
  double value = 0;
  std::string unit;  // shown, never converted
  std::string help;
  std::optional<double> low, high;  // inclusive
  double default_value = 0;         // without settings
};

/// The name is a parameter, "method.CONSTANT", method, spacing, until, cfl, stepping, contact, law, jitter or
/// jitter_seed. The value is a number, a word, or an expression of earlier parameters.
struct Setting {
  std::string name, value;
  FilePlace place = {};  // unknown for the command line
};
Setting parse_setting(const std::string& assignment);
std::string text_of(const Setting& setting);

struct SceneFile {
  std::filesystem::path path;
  std::string text;
  Scene scene;
  Settings settings;
  Drawing drawing;
  double spacing_asked = 0;       // m; the scene has the nearest spacing that divides the first body
  std::string remark;             // warning, one line or empty
  std::optional<double> history;  // interval of history.csv, s
  std::vector<Parameter> parameters;
  std::map<std::string, std::string> unmet_references;  // "holds for other methods", by measure
  TomlValue tree;                                       // with all defaults and settings
  std::map<std::string, FilePlace> places;              // by dotted path: "body.left.velocity"
};

/// The last setting of a name counts. Throws SceneError with file, line and column, UsageError for settings.
SceneFile read_scene(const std::filesystem::path& path, const std::vector<Setting>& settings = {});
/// Reads the stored text again, because a pipe can be read only once.
SceneFile read_again(const SceneFile& scene, const std::vector<Setting>& settings = {});
std::vector<std::string> names_to_set(const SceneFile& scene);
/// Words that the setting `name` allows; empty if it takes numbers.
std::vector<std::string> texts_to_set(std::string_view name);
/// Sets what a drawing takes from the scene. Throws UsageError if the drawing does not fit the scene.
void suit(Drawing& drawing, const SceneFile& scene);
/// Adds file, line and column to an error of the engine.
SceneError locate(const SceneFile& scene, const SceneError& error);
/// Writes TOML with all defaults and the current history and drawing, to be read from `folder`.
std::string resolved_text(const SceneFile& scene, const std::filesystem::path& folder);
/// Removes [render] except `frames`, because a drawing can change after the run. Throws SceneError for invalid TOML.
std::string undrawn(const std::string& scene);

}  // namespace taut::cli
