#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
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
  double default_value = 0;         // the value without overrides
};

/// What the command line changes about a scene file; everything else stands in the file. A name of `set` is a
/// parameter, "method.CONSTANT" or one of method, spacing, until, cfl, stepping, contact, law; the last one
/// of a name counts, before `method`, `spacing` and `until`. A value is a number or an expression of the
/// parameters before it.
struct Overrides {
  std::vector<std::pair<std::string, std::string>> set;  // "--set name=value", in order, value as typed
  std::optional<std::string> method;
  std::optional<double> spacing, until;
};

/// A scene file as read: the engine's scene and what only the program needs.
struct SceneFile {
  std::filesystem::path path;
  Scene scene;
  Settings settings;  // method, all its constants, stepping, cfl
  Drawing drawing;
  std::optional<double> history;  // interval of history.csv, s; until / 1000 where the file says nothing
  std::vector<Parameter> parameters;
  TomlValue tree;                           // of the file, with every default and what was changed
  std::map<std::string, FilePlace> places;  // by dotted path: "spacing", "body.left.velocity"
};

/// Throws SceneError (with file, line, column) for the file, UsageError for the overrides.
SceneFile read_scene(const std::filesystem::path& path, const Overrides& overrides = {});
/// The names that --set and --grid take in this scene with its method.
std::vector<std::string> names_to_set(const SceneFile& scene);
/// The texts that a name of these takes: of methods, contact laws, ways of stepping; none: it takes numbers.
std::vector<std::string> texts_to_set(std::string_view name);
/// `error`, thrown by the engine for this scene, with the file and the place of its key.
SceneError locate(const SceneFile& scene, const SceneError& error);
/// The scene as run, in TOML, every default written out, history and drawing as they stand in `scene` now;
/// reading it gives the same scene.
std::string resolved_text(const SceneFile& scene);

}  // namespace taut::cli
