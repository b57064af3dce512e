#include "cli/sweep/sweep_file.hpp"

#include <algorithm>
#include <set>

#include <fmt/core.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/sections.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/scene/toml_cursor.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;
using Kind = TomlValue::Kind;

class SettingsReader {
 public:
  explicit SettingsReader(TomlCursor& table) : table_(table) {}

  std::vector<Setting> settings() {
    std::vector<Setting> all;
    for (const TomlEntry& entry : table_.table().entries) {
      refuse_table(entry);
      all.push_back(setting(entry.key, entry.value));
    }
    return all;
  }

  std::vector<Axis> axes() {
    std::vector<Axis> all;
    for (const TomlEntry& entry : table_.table().entries) {
      refuse_table(entry);
      all.push_back({entry.key, values(entry)});
      if (all.back().values.empty()) table_.fail(entry.value, entry.key, entry.key + " has no values");
    }
    return all;
  }

 private:
  /// TOML reads method.zeta = 3 as a table `method`.
  void refuse_table(const TomlEntry& entry) const {
    if (entry.value.kind != Kind::table || entry.value.entries.empty()) return;
    table_.fail(entry.place, entry.key,
                fmt::format(R"(a name with a dot must be quoted: "{}.{}" = ...)", entry.key,
                            entry.value.entries.front().key));
  }

  Setting setting(const std::string& name, const TomlValue& value) const {
    if (value.kind == Kind::number) return {name, exact(value.number), value.place};
    if (value.kind != Kind::text || canonical_value(value.text).empty())
      table_.fail(value, name,
                  fmt::format("{} must be a number or a text, not {}", name,
                              value.kind == Kind::text ? "an empty text" : value.kind_name()));
    return {name, canonical_value(value.text), value.place};
  }

  std::vector<Setting> values(const TomlEntry& entry) const {
    std::vector<Setting> all;
    if (entry.value.kind == Kind::text) {
      try {
        for (const std::string& value : parse_values(entry.value.text))
          all.push_back({entry.key, value, entry.value.place});
      } catch (const UsageError& error) {
        table_.fail(entry.value, entry.key, error.what());
      }
    } else if (entry.value.kind == Kind::array) {
      for (const TomlValue& item : entry.value.items) {
        all.push_back(setting(entry.key, item));
        const auto same = [&](const Setting& s) { return s.value == all.back().value; };
        if (std::ranges::count_if(all, same) > 1)
          table_.fail(item, entry.key, fmt::format("{} has the value {} twice", entry.key, all.back().value));
      }
    } else {
      all.push_back(setting(entry.key, entry.value));
    }
    return all;
  }

  TomlCursor& table_;
};

std::vector<Axis> read_grid(TomlCursor& root) {
  TomlValue* grid = root.find("grid");
  if (!grid) return {};
  TomlCursor cursor = root.enter(*grid, "grid", "[grid]", keys_of("grid"));
  std::vector<Axis> axes = SettingsReader(cursor).axes();
  if (axes.empty()) root.fail(*grid, "grid", "[grid] is empty; it needs a line NAME = VALUES");
  return axes;
}

/// A [[row]] beside a [grid] is run with every combination of the grid's names that the row does not set.
std::vector<GridRow> read_rows(TomlCursor& root) {
  const std::vector<Axis> axes = read_grid(root);
  const std::span<TomlValue> listed = root.list("row");
  if (axes.empty() && listed.empty())
    root.fail(root.table().place, "", "the sweep needs a [grid], or a [[row]] for each run");
  std::vector<GridRow> rows;
  if (!axes.empty()) rows = all_combinations(axes);
  std::set<std::string> seen;
  for (const GridRow& row : rows) seen.insert(folder_name(row));
  for (TomlValue& row : listed) {
    TomlCursor cursor = root.enter(row, "row", "[[row]]", keys_of("row"));
    const std::vector<Setting> own = SettingsReader(cursor).settings();
    std::vector<Axis> others = axes;
    std::erase_if(others, [&](const Axis& axis) {
      return std::ranges::find(own, axis.name, &Setting::name) != own.end();
    });
    for (const GridRow& combination : all_combinations(others)) {
      rows.push_back(combination);
      rows.back().insert(rows.back().end(), own.begin(), own.end());
      if (!seen.insert(folder_name(rows.back())).second)
        root.fail(row, "row", fmt::format("the run {} is listed twice", text_of(rows.back())));
    }
  }
  return rows;
}

}  // namespace

std::vector<Setting> read_settings(TomlCursor& table) { return SettingsReader(table).settings(); }

std::vector<Setting> merged(const std::vector<Setting>& common, const std::vector<Setting>& own) {
  std::vector<Setting> all = common;
  std::erase_if(
      all, [&](const Setting& s) { return std::ranges::find(own, s.name, &Setting::name) != own.end(); });
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

std::string find_scene_of(TomlCursor& root, const fs::path& file) {
  const std::string scene = root.text("scene");
  std::error_code error;
  const fs::path beside = file.parent_path() / scene;
  if (fs::is_regular_file(beside, error)) return beside.string();
  if (fs::is_fifo(scene, error))
    root.fail(*root.find("scene"), "scene", fmt::format("'{}' is a named pipe; name a scene file", scene));
  try {
    return find_scene(scene).string();
  } catch (const UsageError& problem) {
    root.fail(*root.find("scene"), "scene", problem.what());
  }
}

bool is_sweep_file(const fs::path& path) {
  const TomlValue tree = parse_toml(file_text(path), path.string());
  return tree.find("scene") || tree.find("grid") || tree.find("row");
}

SweepFile read_sweep(const fs::path& path) {
  TomlSource source;
  source.file = path.string();
  TomlValue tree = parse_toml(file_text(path), source.file);
  TomlCursor root(tree, "", "the sweep", keys_of("sweep"), {}, source);
  if (tree.find("body") && !tree.find("grid") && !tree.find("row"))
    throw UsageError(fmt::format("'{}' is a scene; to sweep it add --grid NAME=VALUES", path.string()));
  root.refuse_unknown_keys();
  SweepFile file;
  file.path = path;
  file.title = root.line("title", "");
  file.scene = find_scene_of(root, path);
  if (TomlValue* set = root.find("set")) {
    TomlCursor cursor = root.enter(*set, "set", "'set'", keys_of("set"));
    file.set = SettingsReader(cursor).settings();
  }
  file.repeat = root.whole("repeat");
  file.pictures = read_pictures(root);
  try {
    file.rows = read_rows(root);
    check_rows(file.rows);
  } catch (const UsageError& error) {
    const TomlEntry* rows = tree.find(tree.find("grid") ? "grid" : "row");
    root.fail(rows->place, rows->key, error.what());
  }
  return file;
}

}  // namespace taut::cli
