#include "cli/scene/scene_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "cli/text/shown.hpp"
#include "cli/text/suggest.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

void collect_places(const TomlValue& value, const std::string& path,
                    std::map<std::string, FilePlace>& places) {
  if (!path.empty()) places.emplace(path, value.place);
  for (const TomlEntry& entry : value.entries)
    collect_places(entry.value, path.empty() ? entry.key : fmt::format("{}.{}", path, entry.key), places);
  for (const TomlValue& item : value.items) {
    const TomlEntry* name = item.find("name");
    if (name && name->value.kind == TomlValue::Kind::text)
      collect_places(item, fmt::format("{}.{}", path, name->value.text), places);
  }
}

/// Spacings before the fit to the first body, m.
struct RequestedSpacing {
  double value, in_scene;  // with and without settings
};

RequestedSpacing requested_spacing(TomlValue tree, const Changes& changes, TomlSource& source) {
  SceneFile file;
  TomlCursor root(tree, "", "the scene", keys_of("scene"), {}, source);
  root.refuse_unknown_keys();  // else misspelt tables would be reported as missing
  read_parameters(root, changes, {}, file);
  const TomlValue& spacing = root.need("spacing");
  const std::set<std::string> unknown_yet = names_that_need_dp(root, changes);
  for (const std::string& name :
       spacing.kind == TomlValue::Kind::text ? names_in(spacing.text) : std::set<std::string>{})
    if (unknown_yet.contains(name))
      root.fail(spacing, "spacing",
                fmt::format("spacing = '{}' depends on dp, which is the spacing itself; remove dp from it",
                            spacing.text));
  const double asked = root.number("spacing");
  const std::string* change = changes.find("spacing");
  return {change ? changed_number(key_of_scene("spacing"), *change, root.names()) : asked, asked};
}

void read_head(TomlCursor& root, SceneFile& file) {
  Scene& scene = file.scene;
  scene.name = root.line("name", file.path.stem().string());
  if (scene.name.find('/') != std::string::npos || scene.name == "." || scene.name == "..")
    root.fail(
        root.need("name"), "name",
        fmt::format("name = '{}' must not contain '/' or be '.' or '..', because it names the run folder",
                    shown(scene.name)));
  scene.title = root.line("title", scene.name);
  scene.source = root.line("source", "");
  scene.dim = root.whole("dim");
}

double read_setting(TomlCursor& root, const char* key, const Changes& changes, SceneFile& file) {
  const double in_scene = root.number(key);
  const std::string* change = changes.find(key);
  const double value = change ? changed_number(key_of_scene(key), *change, root.names()) : in_scene;
  resolve(file, key, value, in_scene, default_number(key_of_scene(key)).value_or(in_scene));
  if (!change) return value;
  TomlValue written(value);
  written.whole = root.need(key).whole;
  root.table().set(key, std::move(written));
  return value;
}

void read_times(TomlCursor& root, const Changes& changes, double dp, SceneFile& file) {
  constexpr double default_rows = 1000;
  root.find("spacing");
  root.table().set("spacing", TomlValue(dp));
  file.scene.spacing = dp;
  file.scene.until = read_setting(root, "until", changes, file);
  // far above subnormal numbers, where sums of time steps lose digits
  constexpr double least_until = 1e-100;
  if (file.scene.until < least_until)
    root.fail(root.need("until"), "until",
              fmt::format("until = {} s must be at least {} s", exact(file.scene.until), exact(least_until)));
  root.table().set("until", TomlValue(file.scene.until));
  file.history = root.find("history") ? root.number("history") : file.scene.until / default_rows;
  root.table().set("history", TomlValue(*file.history));
}

bool has_spacing(const std::string& expression) {
  const auto in_a_name = [&](std::size_t k) {
    return k < expression.size() &&
           (std::isalnum(static_cast<unsigned char>(expression[k])) != 0 || expression[k] == '_');
  };
  for (std::size_t at = expression.find("dp"); at != std::string::npos; at = expression.find("dp", at + 1))
    if (!in_a_name(at + 2) && (at == 0 || !in_a_name(at - 1))) return true;
  return false;
}

std::string in_spacings_already(const std::string& given) {
  return fmt::format(
      "jitter = {} must not contain dp, because jitter is in spacings; write jitter=0.1 for a tenth of dp",
      given);
}

void read_jitter(TomlCursor& root, const Changes& changes, SceneFile& file) {
  Jitter& jitter = file.scene.jitter;
  root.need("jitter_seed");
  if (const TomlValue* given = root.find("jitter"); given && has_spacing(given->text))
    root.fail(*given, "jitter", in_spacings_already(given->text));
  if (const std::string* change = changes.find("jitter"); change && has_spacing(*change))
    throw UsageError(in_spacings_already(*change));
  jitter.share = read_setting(root, "jitter", changes, file);
  jitter.seed = static_cast<int>(read_setting(root, "jitter_seed", changes, file));
}

/// In scene.toml of a run, a setting may have replaced the only use of a parameter.
void refuse_unused_parameters(TomlCursor& root, const TomlValue& original, const TomlSource& source) {
  const TomlEntry* parameters = original.find("parameters");
  if (!parameters) return;
  for (const TomlEntry& entry : parameters->value.entries)
    if (!source.used.contains(entry.key) && !entry.value.find("default"))
      root.fail(entry.place, "parameters." + entry.key,
                fmt::format("the parameter '{}' is unused; remove it or use it in an expression", entry.key));
}

/// Throws UsageError if the contact law of the settings does not suit the method or the bodies.
void check_contact(const Changes& changes, const SceneFile& file) try {
  if (changes.find("contact")) contact_law(file.scene, *find_method(file.settings.method));
} catch (const SceneError& error) {
  throw UsageError(fmt::format("--set contact={}: {}", *changes.find("contact"), error.what()));
}

/// The constructor reads what `fitted` needs.
class SceneReading {
 public:
  SceneReading(double dp, const std::filesystem::path& path, const TomlValue& original,
               const Changes& changes, TomlSource& source)
      : original_(original),
        source_(source),
        root_(start(path, original), "", "the scene", keys_of("scene"), {}, source) {
    read_head(root_, file_);
    source_.dim = file_.scene.dim;
    read_parameters(root_, changes, dp, file_);
    read_settings(root_, changes, file_);
    read_times(root_, changes, dp, file_);
    read_jitter(root_, changes, file_);
    read_gravity_and_damping(root_, file_.scene);
    read_materials(root_, file_.scene);
    file_.scene.element_order = find_method(file_.settings.method)->formulation.element_order;
    read_bodies(root_, find_method(file_.settings.method)->keeps_neighbors, file_);
    name_touching(root_, file_);
    check_contact(changes, file_);
  }

  double fitted() const {
    const Scene& scene = file_.scene;
    return fitted_spacing(scene.bodies.front(), scene.dim, scene.spacing);
  }

  SceneFile finish() {
    read_walls(root_, file_.scene);
    read_probes(root_, file_.scene);
    read_lines(root_, file_.scene);
    read_measures(root_, file_.scene);
    read_references(root_, file_);
    read_drawing(root_, file_.scene, file_.drawing);
    refuse_unused_parameters(root_, original_, source_);
    collect_places(file_.tree, "", file_.places);
    return std::move(file_);
  }

 private:
  TomlValue& start(const std::filesystem::path& path, const TomlValue& original) {
    file_.path = path;
    return file_.tree = original;
  }

  const TomlValue& original_;
  TomlSource& source_;
  SceneFile file_;
  TomlCursor root_;
};

void refuse_too_coarse(double asked, double fitted, const TomlValue& tree, const Changes& changes,
                       const TomlSource& source) {
  constexpr double coarse = 2;
  if (!(asked > coarse * fitted)) return;
  const std::string what = fmt::format(
      "spacing = {} m is more than twice the thickness of the first body, {} m; "
      "choose a smaller spacing, because a body needs several rows of particles",
      brief(asked), brief(fitted));
  if (changes.find("spacing")) throw UsageError(what);
  const FilePlace place = tree.find("spacing")->value.place;
  throw SceneError(source.file, place.line, place.column, "spacing", what);
}

SceneFile read_text(const std::string& text, const std::filesystem::path& path,
                    const std::vector<Setting>& settings) {
  TomlSource source;
  source.file = path.string();
  const TomlValue tree = parse_toml(text, source.file);
  const Changes changes = by_target(settings);
  constexpr int most_rounds = 10;
  const RequestedSpacing requested = requested_spacing(tree, changes, source);
  double dp = requested.value;
  for (int round = 0; round < most_rounds; ++round) {
    SceneReading reading(dp, path, tree, changes, source);
    if (reading.fitted() == dp) {
      SceneFile file = reading.finish();
      file.requested_spacing = requested.value;
      resolve(file, "spacing", requested.value, requested.in_scene, requested.in_scene);
      file.text = text;
      return file;
    }
    refuse_too_coarse(dp, reading.fitted(), tree, changes, source);
    dp = reading.fitted();
  }
  const FilePlace place = tree.find("spacing")->value.place;
  throw SceneError(source.file, place.line, place.column, "spacing",
                   "no spacing divides the first body into whole particles, because its size depends on dp; "
                   "remove dp from its size");
}

}  // namespace

SceneFile read_scene(const std::filesystem::path& path, const std::vector<Setting>& settings) {
  return read_text(file_text(path), path, settings);
}

SceneFile with_settings(const SceneFile& file, const std::vector<Setting>& settings) {
  return read_text(file.text, file.path, settings);
}

SceneError locate(const SceneFile& scene, const SceneError& error) {
  if (error.line > 0) return error;
  std::string key = error.key;
  while (!key.empty() && !scene.places.contains(key)) {
    const std::size_t dot = key.rfind('.');
    key.resize(dot == std::string::npos ? 0 : dot);
  }
  const auto found = scene.places.find(key);
  const FilePlace place = found == scene.places.end() ? FilePlace{} : found->second;
  return {scene.path.string(), place.line, place.column, error.key, error.what()};
}

std::string resolved_text(const SceneFile& scene, const std::filesystem::path& folder) {
  TomlValue tree = scene.tree;
  if (scene.history) tree.set("history", TomlValue(*scene.history));
  tree.set("render", drawing_table(scene.drawing));
  make_paths_relative(folder, tree);
  return print_toml(tree);
}

std::string without_drawing(const std::string& scene) {
  TomlValue tree = parse_toml(scene, "scene.toml");
  if (TomlEntry* render = tree.find("render"))
    render->value.entries.remove_if([](const TomlEntry& entry) { return entry.key != "frames"; });
  return print_toml(tree);
}

}  // namespace taut::cli
