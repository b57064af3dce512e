#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
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

/// A change of a scene, as in `--set name=value`. The name is a parameter, "method.CONSTANT" or one of
/// setting_infos(). The value is a number, a word, or an expression of earlier parameters.
struct Setting {
  std::string name, value;
  FilePlace place = {};  // unknown for the command line
};
Setting parse_setting(const std::string& assignment);
std::string text_of(const Setting& setting);

/// A setting that every scene has, beside parameters and constants of the method.
struct SettingInfo {
  std::string_view name;
  std::string_view column;       // in results.csv
  std::string_view label;        // on panels: "CFL {}"; empty: none of this form
  bool of_scene;                 // runs with different values simulate different scenes
  std::string_view fixed_since;  // reason why a session cannot change it; empty: it can
};
std::span<const SettingInfo> setting_infos();
inline constexpr std::string_view constant_prefix = "method.";

/// A parameter, constant or other setting as the run uses it.
struct ResolvedSetting {
  /// First of these that gives the value.
  enum class Source { by_default, scene, setting };
  std::string name;
  std::string value, default_value;  // a number is written exactly; without a default, the value in the scene
  Source source = Source::by_default;
};

struct SceneFile {
  std::filesystem::path path;
  std::string text;  // contents of the file
  Scene scene;
  Settings settings;
  Drawing drawing;
  double requested_spacing = 0;   // m; the scene has the nearest spacing that divides the first body
  std::string remark;             // warning, one line or empty
  std::optional<double> history;  // interval of history.csv, s; default: until / 1000
  std::vector<Parameter> parameters;
  std::vector<ResolvedSetting> resolved;                // every setting
  std::map<std::string, std::string> unmet_references;  // failed conditions of references, by measure
  TomlValue tree;                                       // of the file, with all defaults and settings
  std::map<std::string, FilePlace> places;              // by dotted path: "body.left.velocity"

  /// Returns nullptr for other names.
  const ResolvedSetting* find_resolved(std::string_view name) const;
};

/// Reads a scene file with settings; if a name is set repeatedly, its last setting counts. Throws SceneError with file,
/// line and column, UsageError for settings.
SceneFile read_scene(const std::filesystem::path& path, const std::vector<Setting>& settings = {});
/// Names that --set and --grid accept for this scene and its method.
std::vector<std::string> names_to_set(const SceneFile& scene);
/// Words that the setting `name` allows; empty if it takes numbers.
std::vector<std::string> allowed_words(std::string_view name);
/// Sets the members of a drawing that depend on the scene: cut, follow, the camera in 3D. Throws UsageError if the
/// drawing does not fit the scene.
void apply_scene(Drawing& drawing, const SceneFile& scene);
/// Returns an error of the engine with file, line and column of its key.
SceneError locate(const SceneFile& scene, const SceneError& error);
/// TOML of the scene with all defaults, and the current history and drawing. Reading it from `folder` gives the same
/// scene.
std::string resolved_text(const SceneFile& scene, const std::filesystem::path& folder);
/// Text of a scene without [render], except `frames`: a drawing can change after the run. Throws SceneError for
/// invalid TOML.
std::string without_drawing(const std::string& scene);

}  // namespace taut::cli
