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
  std::string unit;  // never converted
  std::string help;
  std::optional<double> low, high;  // inclusive
  double default_value = 0;
};

struct Setting {
  std::string name, value;
  FilePlace place = {};
};
Setting parse_setting(const std::string& assignment);
std::string text_of(const Setting& setting);

/// A setting that every scene has.
struct SettingInfo {
  std::string_view name;
  std::string_view column;       // in results.csv
  std::string_view label;        // on panels: "CFL {}"
  bool of_scene;                 // different values make different scenes
  std::string_view fixed_since;  // reason against changes in a session, or empty
};
std::span<const SettingInfo> setting_infos();
inline constexpr std::string_view constant_prefix = "method.";

struct ResolvedSetting {
  /// Last source that changed the value.
  enum class Source { by_default, scene, setting };
  std::string name;
  std::string value;
  std::string default_value;  // the scene's value if the setting has no default
  Source source = Source::by_default;
};

struct SceneFile {
  std::filesystem::path path;
  std::string text;
  Scene scene;
  Settings settings;
  Drawing drawing;
  double requested_spacing = 0;   // m; before the fit to the first body
  std::string remark;             // one line or empty
  std::optional<double> history;  // interval of history.csv, s; default: until / 1000
  std::vector<Parameter> parameters;
  std::vector<ResolvedSetting> resolved;
  std::map<std::string, std::string> unmet_references;  // failed conditions, by measure
  TomlValue tree;                                       // with defaults and settings
  std::map<std::string, FilePlace> places;              // by path: "body.left.velocity"

  const ResolvedSetting* find_resolved(std::string_view name) const;
};

/// The last setting of a name counts. Throws SceneError for the file, UsageError for settings.
SceneFile read_scene(const std::filesystem::path& path, const std::vector<Setting>& settings = {});
/// Applies only these settings to the text in `file`. Reads tables and shape files again.
SceneFile with_settings(const SceneFile& file, const std::vector<Setting>& settings);
/// Names for --set and --grid.
std::vector<std::string> names_to_set(const SceneFile& scene);
/// Allowed words of a setting; empty if it takes numbers.
std::vector<std::string> allowed_words(std::string_view name);
/// Sets members that depend on the scene. Throws UsageError if `drawing` does not fit.
void apply_scene(Drawing& drawing, const SceneFile& scene);
/// Adds file, line and column to an error without a place.
SceneError locate(const SceneFile& scene, const SceneError& error);
/// TOML with all defaults; gives the same scene when read from `folder`.
std::string resolved_text(const SceneFile& scene, const std::filesystem::path& folder);
/// Keeps only `frames` of [render]. Throws SceneError for invalid TOML.
std::string without_drawing(const std::string& scene);

}  // namespace taut::cli
