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

/// A scene's parameter: may be set with --set and swept.
struct Parameter {
  std::string name;
  double value = 0;
  std::string unit;  // shown to the user; no conversion is made
  std::string help;
  std::optional<double> low, high;  // bounds, both included
  double default_value = 0;         // the value without settings
};

/// One thing that is changed about a scene file, whose other values stand: what `--set name=value` says. The
/// name is a parameter, "method.CONSTANT" or one of method, spacing, until, cfl, stepping, contact, law, jitter,
/// jitter_seed; the value is a number, an expression of the parameters before it, or a name.
struct Setting {
  std::string name, value;
  FilePlace place = {};  // in a sweep file; unknown for the command line
};
/// Of "name=value".
Setting parse_setting(const std::string& assignment);
/// "name=value"
std::string text_of(const Setting& setting);

/// A scene file as read: the engine's scene and what only the program needs.
struct SceneFile {
  std::filesystem::path path;
  std::string text;  // of the file
  Scene scene;
  Settings settings;  // method, all its constants, stepping, cfl
  Drawing drawing;
  double spacing_asked = 0;       // m; that of the scene is the nearest one that divides the first body
  std::string remark;             // what the user is told of the reading, in one line; mostly empty
  std::optional<double> history;  // interval of history.csv, s; until / 1000 where the file says nothing
  std::vector<Parameter> parameters;
  /// By measure: the condition of a reference that does not hold here, "holds for the methods icb".
  std::map<std::string, std::string> unmet_references;
  TomlValue tree;                           // of the file, with every default and what was changed
  std::map<std::string, FilePlace> places;  // by dotted path: "spacing", "body.left.velocity"
};

/// Of several settings of one name the last one counts. Throws SceneError (with file, line, column) for the
/// file, UsageError for the settings.
SceneFile read_scene(const std::filesystem::path& path, const std::vector<Setting>& settings = {});
/// The same text with other settings: what comes through a pipe can be read only once.
SceneFile read_again(const SceneFile& scene, const std::vector<Setting>& settings = {});
/// The names that --set and --grid take in this scene with its method.
std::vector<std::string> names_to_set(const SceneFile& scene);
/// The texts that a name of these takes: of methods, laws of contact and of elasticity, ways of stepping;
/// none: it takes numbers.
std::vector<std::string> texts_to_set(std::string_view name);
/// Settles what a drawing of this scene leaves to it: cut, follow, the camera of a scene in 3D. Throws
/// UsageError for what does not go with the scene.
void suit(Drawing& drawing, const SceneFile& scene);
/// `error`, thrown by the engine for this scene, with the file and the place of its key.
SceneError locate(const SceneFile& scene, const SceneError& error);
/// The scene as run, in TOML, every default written out, history and drawing as they stand in `scene` now;
/// reading it from `folder` gives the same scene.
std::string resolved_text(const SceneFile& scene, const std::filesystem::path& folder);
/// Of such a text what makes a run: without the drawing, which may be changed afterwards, but for the number of its
/// frames. Throws SceneError for what is no TOML.
std::string undrawn(const std::string& scene);

}  // namespace taut::cli
