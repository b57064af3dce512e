#include "cli/sweep/suite_file.hpp"

#include <algorithm>

#include "cli/scene/sections.hpp"
#include "cli/scene/toml_cursor.hpp"
#include "cli/sweep/sweep_file.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

std::optional<double> read_difference(TomlCursor& cursor, std::string_view key) {
  const TomlValue* value = cursor.find(key);
  if (!value) return std::nullopt;
  const double difference = cursor.number(key);
  if (difference < 0)
    cursor.fail(*value, key, std::string(key) + " = " + brief(difference) + " must be at least 0");
  return difference;
}

void read_setting(TomlCursor& cursor, std::string_view key, std::vector<Setting>& settings) {
  const TomlValue* value = cursor.find(key);
  if (!value) return;
  if (std::ranges::find(settings, key, &Setting::name) != settings.end())
    cursor.fail(*value, key,
                std::string(key) + " and set." + std::string(key) + " set the same value; leave one out");
  const bool is_number = value->kind == TomlValue::Kind::number;
  settings.push_back(
      {std::string(key), is_number ? exact(value->number) : cursor.text_of(*value, key), value->place});
}

void read_common(TomlCursor& cursor, SuiteEntry& entry) {
  if (TomlValue* set = cursor.find("set")) {
    TomlCursor table = cursor.enter(*set, "set", "'set'", keys_of("set"));
    entry.settings = read_settings(table);
  }
  if (TomlValue* render = cursor.find("render")) {
    TomlCursor table = cursor.enter(*render, "render", "'render'", keys_of("render"));
    table.refuse_unknown_keys();
    entry.drawing = read_drawing_values(table);
  }
  entry.warn = read_difference(cursor, "warn");
  entry.fail = read_difference(cursor, "fail");
}

SuiteEntry read_entry(TomlCursor& cursor, const std::vector<std::string>& taken, const fs::path& file) {
  SuiteEntry entry;
  entry.name = label(cursor, taken);
  entry.place = cursor.table().place;
  read_common(cursor, entry);
  for (const std::string_view key : {"method", "until"}) read_setting(cursor, key, entry.settings);
  entry.differs_from = cursor.text("differs_from", "");
  const TomlValue* scene = cursor.find("scene");
  if (entry.is_control() && scene)
    cursor.fail(*scene, "scene",
                "a control has the scene of the entry from which it differs; leave scene out");
  if (!entry.is_control()) entry.scene = find_scene_of(cursor, file);
  return entry;
}

SuiteEntry over(const SuiteEntry& below, SuiteEntry own) {
  own.settings = merged(below.settings, own.settings);
  own.drawing.insert(below.drawing.begin(), below.drawing.end());
  if (own.scene.empty()) own.scene = below.scene;
  if (!own.warn) own.warn = below.warn;
  if (!own.fail) own.fail = below.fail;
  return own;
}

void check_limits(const TomlCursor& root, const SuiteEntry& entry) {
  if (entry.warn && entry.fail && *entry.warn >= *entry.fail)
    root.fail(entry.place, "entry." + entry.name + ".warn",
              "the entry " + entry.name + " warns at " + brief(*entry.warn) + " and fails at " +
                  brief(*entry.fail) + "; warn must be less than fail");
}

void complete_controls(TomlCursor& root, std::vector<SuiteEntry>& entries) {
  std::vector<std::string> owners;
  for (const SuiteEntry& entry : entries)
    if (!entry.is_control()) owners.push_back(entry.name);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (!entries[k].is_control()) continue;
    const std::string& owner = entries[k].differs_from;
    if (std::ranges::find(owners, owner) == owners.end())
      root.fail_unknown(root.list("entry")[k].find("differs_from")->value, "differs_from", "entry", owner,
                        owners);
    entries[k] = over(entries[index_of(entries, owner)], entries[k]);
  }
}

}  // namespace

bool is_suite_file(const fs::path& path) {
  const TomlValue tree = parse_toml(file_text(path), path.string());
  return tree.find("entry") || tree.find("baselines");
}

SuiteFile read_suite(const fs::path& path) {
  TomlSource source;
  source.file = path.string();
  TomlValue tree = parse_toml(file_text(path), source.file);
  TomlCursor root(tree, "", "the suite", keys_of("suite"), {}, source);
  root.refuse_unknown_keys();
  SuiteFile suite;
  suite.path = path;
  suite.title = root.line("title", path.stem().string());
  suite.baselines = path.parent_path() / root.text("baselines", path.stem().string());
  SuiteEntry common;
  read_common(root, common);
  root.need("entry");
  read_each(root, "entry", [&](TomlCursor& cursor) {
    cursor.refuse_unknown_keys();
    const SuiteEntry own = read_entry(cursor, names_of(suite.entries), path);
    suite.entries.push_back(own.is_control() ? own : over(common, own));
  });
  if (suite.entries.empty())
    root.fail(root.need("entry"), "entry", "the suite has no entry; add an [[entry]]");
  complete_controls(root, suite.entries);
  for (const SuiteEntry& entry : suite.entries) check_limits(root, entry);
  return suite;
}

}  // namespace taut::cli
