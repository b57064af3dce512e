#include "cli/study/stored_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>
#include <span>
#include <sstream>

#include <fmt/core.h>

#include "cli/scene/scene_file.hpp"
#include "cli/study/csv.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "cli/text/json_cursor.hpp"
#include "cli/text/shown.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_title = 200;
constexpr std::string_view parameter_prefix = "parameters.";
constexpr std::string_view fixed_prefix = "fixed.";  // for all runs of a sweep

fs::path results_file(const std::string& given) {
  std::error_code error;
  if (!fs::is_directory(given, error)) return given;
  if (fs::is_regular_file(fs::path(given) / "results.csv", error)) return fs::path(given) / "results.csv";
  throw UsageError(fmt::format("'{}' contains no results.csv; name the folder of a sweep", given));
}

void check_columns(const fs::path& file, const CsvTable& table) {
  constexpr std::array needed = {"status",    "scene", "method",  "spacing",
                                 "particles", "steps", "verdict", "seconds.solve"};
  std::vector<std::string> missing;
  for (const char* column : needed)
    if (std::ranges::find(table.columns, column) == table.columns.end()) missing.emplace_back(column);
  if (missing.empty()) return;
  if (std::ranges::find(table.columns, "status") != table.columns.end() &&
      missing.size() + 1 == needed.size())
    throw UsageError(
        fmt::format("no run in '{}' has a result yet; continue with `taut sweep`", file.string()));
  throw UsageError(fmt::format("'{}' is not the results.csv of a sweep: it has no column {}", file.string(),
                               join(missing)));
}

Json tree_of(const std::vector<std::string>& columns) {
  Json tree = Json::object();
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k] == "status" || columns[k].starts_with(set_prefix)) continue;
    Json* node = &tree;
    std::istringstream path(columns[k]);
    for (std::string key; node->is_object() && std::getline(path, key, '.');) {
      node = &(*node)[key];
      if (node->is_null() && !path.eof()) *node = Json::object();
    }
    if (node->is_null()) *node = k;
  }
  return tree;
}

Json with_cells(const Json& tree, const std::vector<std::string>& row) {
  if (!tree.is_object()) {
    const std::string& cell = row[static_cast<std::size_t>(tree.number())];
    return cell.empty() ? Json() : Json(cell);
  }
  Json json;
  for (const auto& [key, inner] : tree.members())
    if (Json value = with_cells(inner, row); !value.is_null()) {
      if (json.is_null()) json = Json::object();
      json.append(key, std::move(value));
    }
  return json;
}

std::vector<StoredRun> read_runs(const fs::path& path) {
  const CsvTable table = read_csv(path);
  check_columns(path, table);
  const std::string file = path.string();
  const Json tree = tree_of(table.columns);
  std::vector<StoredRun> runs;
  for (const auto& row : table.rows) {
    StoredRun& run = runs.emplace_back();
    run.file = file;
    const Json json = with_cells(tree, row);
    if (json.is_object()) run.record = record_from(JsonCursor(json, file, "", /*texts_are_numbers=*/true));
    for (std::size_t k = 0; k < row.size(); ++k)
      if (!row[k].empty()) run.cells.emplace_back(table.columns[k], row[k]);
    run.status = run.text("status");
  }
  return runs;
}

/// Returns the common settings.
StoredSettings add_names(const fs::path& table, StoredResults& results) {
  constexpr std::uint64_t most_bytes = 256 << 20;
  const std::string file = (table.parent_path() / "results.json").string();
  const auto text = read_whole(file, most_bytes);
  if (!text) return {};
  const auto json = parse_json(*text, file);
  const JsonCursor top(json, file);
  if (const std::string title = top.at("title").text(); results.title.empty())
    results.title = abridged(title, longest_title);
  for (const JsonCursor& swept : top.at("swept").items()) {
    const std::string unit = swept.at("unit").text(), name = swept.at("name").text();
    if (!unit.empty() && unit != "1") results.units[name] = unit;
  }
  StoredSettings fixed;
  for (const auto& [name, value] : top.at("fixed").members())
    fixed.emplace_back(name, value.number_or_text());
  return fixed;
}

/// Runs of a sweep have the same method unless methods are swept.
void name_only_method(std::span<StoredRun> runs) {
  std::set<std::string> methods;
  for (const StoredRun& run : runs) {
    if (!run.text("set.method").empty()) return;
    if (const std::string name = run.method(); !name.empty()) methods.insert(name);
  }
  if (methods.size() != 1) return;
  for (StoredRun& run : runs) run.record.method = *methods.begin();
}

void add_scene(StoredResults& results, const StoredRun& run) {
  const std::string& scene = run.record.scene;
  if (scene.empty()) return;
  if (results.scene.empty()) results.scene = scene;
  if (scene != results.scene)
    throw UsageError(
        fmt::format("the results are of different scenes: '{}' of {}, '{}' of {}; name results of one scene",
                    results.runs.front().file, results.scene, run.file, scene));
}

std::string without_prefix(const std::string& column) {
  for (const std::string_view prefix : {set_prefix, fixed_prefix, parameter_prefix})
    if (column.starts_with(prefix)) return column.substr(prefix.size());
  return column;
}

/// Settings precede parameters that depend on them.
std::vector<std::string> candidates(const std::vector<StoredRun>& runs) {
  std::vector<std::string> set, parameters;
  std::set<std::string_view> seen;
  for (const StoredRun& run : runs)
    for (const auto& cell : run.cells)
      for (auto [prefix, columns] :
           {std::pair{set_prefix, &set}, {fixed_prefix, &set}, {parameter_prefix, &parameters}})
        if (cell.first.starts_with(prefix) && seen.insert(cell.first).second) columns->push_back(cell.first);
  for (const SettingInfo& info : setting_infos())
    if (info.name != "method" && info.name != "jitter_seed") set.emplace_back(info.column);
  set.insert(set.end(), parameters.begin(), parameters.end());
  return set;
}

}  // namespace

std::string StoredRun::text(std::string_view column) const {
  const auto name = [this](std::uint32_t k) -> std::string_view { return cells[k].first; };
  if (by_column.size() != cells.size()) {
    by_column.resize(cells.size());
    std::iota(by_column.begin(), by_column.end(), 0U);
    std::ranges::stable_sort(by_column, {}, name);
  }
  const auto found = std::ranges::lower_bound(by_column, column, {}, name);
  return found == by_column.end() || name(*found) != column ? "" : cells[*found].second;
}

std::string StoredRun::method() const {
  if (!record.method.empty()) return record.method;
  const std::string swept = text("set.method");
  return swept.empty() ? text("fixed.method") : swept;
}

std::optional<double> StoredRun::value_of(std::string_view measure) const {
  const std::optional<double> value = record.measure(measure).value;
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string StoredRun::folder() const {
  return (fs::path(file).parent_path() / text("folder")).lexically_normal().string();
}

std::vector<std::string> StoredResults::measures() const {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const StoredRun& run : runs)
    for (const MeasureResult& measure : run.record.measures)
      if (seen.insert(measure.name).second) names.push_back(measure.name);
  return names;
}

std::string StoredResults::label(const std::string& name) const {
  const auto unit = units.find(name);
  if (unit != units.end()) return fmt::format("{}, {}", name, unit->second);
  return name == "spacing" ? name + ", m" : name == "until" ? name + ", s" : name;
}

StoredResults read_results(const std::vector<std::string>& files) {
  StoredResults results;
  std::set<fs::path> seen;
  for (const std::string& given : files) {
    const fs::path file = results_file(given);
    if (!seen.insert(file.lexically_normal()).second)
      throw UsageError(fmt::format("'{}' is given twice", file.string()));
    const StoredSettings fixed = add_names(file, results);
    if (seen.size() == 1) results.fixed = fixed;
    std::erase_if(results.fixed,
                  [&](const auto& set) { return std::ranges::find(fixed, set) == fixed.end(); });
    std::vector<StoredRun> runs = read_runs(file);
    for (StoredRun& run : runs)
      for (const auto& [name, value] : fixed) run.cells.emplace_back(std::string(fixed_prefix) + name, value);
    name_only_method(runs);
    for (StoredRun& run : runs) {
      results.runs.push_back(std::move(run));
      add_scene(results, results.runs.back());
    }
  }
  if (std::ranges::none_of(results.runs, &StoredRun::has_result))
    throw UsageError(fmt::format("no run in {} has a result", join(files)));
  if (results.title.empty()) results.title = results.scene;
  return results;
}

StoredRun read_stored_run(const std::string& path) {
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? fs::path(path) / "run.json" : fs::path(path);
  const auto text = read_whole(file);
  const bool is_other = text && file.filename() != "run.json" && !text->starts_with('{');
  if (!text || is_other) throw UsageError(fmt::format("'{}' is neither a run folder nor a run.json", path));
  StoredRecord stored = parse_record(*text, file.string());
  StoredRun run{.file = file.string(), .cells = {{"folder", "."}}};
  for (const auto& [pointer, value] : stored.all.leaves()) {
    std::string column = pointer.substr(1);
    std::ranges::replace(column, '/', '.');
    if (value.is_text())
      run.cells.emplace_back(column, value.text());
    else if (value.is_number())
      run.cells.emplace_back(column, exact(value.number()));
    else if (value.is_null())
      run.cells.emplace_back(column, "");
  }
  run.status = run.text("status");
  run.all = std::move(stored.all);
  run.record = std::move(stored);
  return run;
}

void keep_methods(StoredResults& results, const std::vector<std::string>& methods) {
  if (methods.empty()) return;
  std::vector<std::string> there;
  for (const StoredRun& run : results.runs)
    if (const std::string name = run.method(); std::ranges::find(there, name) == there.end())
      there.push_back(name);
  for (const std::string& method : methods)
    if (std::ranges::find(there, method) == there.end())
      throw UsageError(unknown_name("method", method, there));
  std::erase_if(results.runs, [&](const StoredRun& run) {
    return std::ranges::find(methods, run.method()) == methods.end();
  });
  if (std::ranges::none_of(results.runs, &StoredRun::has_result))
    throw UsageError(fmt::format("no run of {} has a result", join(methods)));
}

std::vector<std::string> names_of_scene(const std::vector<StoredRun>& runs) {
  const auto is_of_scene = [](const std::string& name) {
    const auto infos = setting_infos();
    const auto info = std::ranges::find(infos, name, &SettingInfo::name);
    return info == infos.end() ? !name.starts_with(constant_prefix) : info->of_scene;
  };
  std::vector<std::string> names;
  for (const std::string& column : candidates(runs)) {
    const std::string name = without_prefix(column);
    if (column.starts_with(parameter_prefix) || name == column) continue;  // not set
    if (is_of_scene(name) && std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string value_of(const StoredRun& run, const std::string& name) {
  for (const std::string_view prefix : {parameter_prefix, std::string_view(), set_prefix, fixed_prefix})
    if (const std::string value = run.text(std::string(prefix) + name); !value.empty()) return value;
  return name == "jitter" ? "0" : "";  // omitted without jitter
}

namespace {

/// Value as set: a run fits its spacing to the first body, and an unfinished run has only the text of an expression.
std::string requested_value(const StoredRun& run, const std::string& name) {
  std::string value = run.text(std::string(set_prefix) + name);
  if (value.empty() && name == "spacing") value = run.text("spacing_asked");
  return value.empty() ? value_of(run, name) : value;
}

/// Errors are shares of the reference, unless it is 0.
bool has_reference(const StoredRun& run, const std::string& measure) {
  return run.record.measure(measure).reference.value_or(0) != 0;
}

}  // namespace

std::string ResultColumn::text(const StoredRun& run) const {
  return name == "method" ? run.method() : column.empty() ? value_of(run, name) : run.text(column);
}

std::optional<double> ResultColumn::number(const StoredRun& run) const {
  const auto value = parsed<double>(text(run));
  if (!value || !std::isfinite(*value)) return std::nullopt;
  if (!relative_to.empty() && !has_reference(run, relative_to)) return std::nullopt;
  return is_share ? 100 * *value : *value;
}

namespace {

std::string without_one(const std::string& unit) { return unit == "1" ? "" : unit; }

std::string unit_in(const std::vector<StoredRun>& runs, const std::string& column) {
  for (const StoredRun& run : runs)
    if (const std::string unit = run.text(column); !unit.empty()) return without_one(unit);
  return "";
}

ResultColumn part_of_measure(const StoredResults& results, const std::string& name,
                             const std::string& measure, const std::string& part) {
  const std::string prefix = fmt::format("measures.{}.", measure);
  ResultColumn found{.name = name, .column = prefix + part, .unit = unit_in(results.runs, prefix + "unit")};
  if (part == "value") found.measure = measure;
  const auto is_relative = [&](const StoredRun& run) {
    return has_reference(run, measure) && !run.text(found.column).empty();
  };
  if (part == "error" && std::ranges::any_of(results.runs, is_relative)) found.relative_to = measure;
  found.is_share = part == "error" && (found.unit.empty() || !found.relative_to.empty());
  if (found.is_share) found.unit = "%";
  return found;
}

std::vector<std::string> column_names(const StoredResults& results) {
  std::vector<std::string> names = results.measures();
  std::set<std::string> seen(names.begin(), names.end());
  for (const bool settings : {true, false})
    for (const StoredRun& run : results.runs)
      for (const auto& [column, value] : run.cells) {
        const std::string name = without_prefix(column);
        if (column.starts_with("measures.") || (name != column) != settings) continue;
        if (seen.insert(name).second) names.push_back(name);
      }
  return names;
}

}  // namespace

ResultColumn find_result_column(const StoredResults& results, const std::string& name) {
  const std::vector<std::string> measures = results.measures();
  for (const std::string& measure : measures) {
    if (name == measure) return part_of_measure(results, name, measure, "value");
    for (const char* part : {"value", "reference", "error"})
      if (const std::string path = fmt::format("{}.{}", measure, part);
          name == path || name == "measures." + path)
        return part_of_measure(results, fmt::format("{} ({})", measure, part), measure, part);
  }
  const auto has = [&](const auto& cell) {
    return std::ranges::any_of(results.runs, [&](const StoredRun& run) { return !cell(run).empty(); });
  };
  if (name == "method" || has([&](const StoredRun& run) { return value_of(run, name); })) {
    const std::string label = results.label(name);
    const std::size_t comma = label.rfind(", ");
    const bool seconds = name.starts_with("seconds.") || name.starts_with("since.") || name == "reached";
    return {.name = name,
            .column = "",
            .unit = comma == std::string::npos ? seconds ? "s" : "" : without_one(label.substr(comma + 2))};
  }
  throw UsageError(unknown_name("column or measure", name, column_names(results)));
}

std::vector<std::string> distinguishing_columns(const std::vector<StoredRun>& runs, const std::string& x) {
  std::vector<std::string> chosen;
  for (const std::string& column : candidates(runs)) {
    const std::string name = without_prefix(column);
    if (name == without_prefix(x) || name == "method") continue;
    std::map<std::vector<std::string>, std::string> seen;
    const bool differs = std::ranges::any_of(runs, [&](const StoredRun& run) {
      if (!run.has_result() && !column.starts_with(set_prefix) && !column.starts_with(fixed_prefix))
        return false;
      std::vector<std::string> key{run.method(), run.text(x)};
      for (const std::string& c : chosen) key.push_back(value_of(run, without_prefix(c)));
      const std::string value = value_of(run, name);
      return seen.emplace(key, value).first->second != value;
    });
    if (differs) chosen.push_back(column);
    if (!differs && seen.size() == runs.size()) break;
  }
  return chosen;
}

std::string series_name(const StoredRun& run, const std::vector<std::string>& columns) {
  const MethodInfo* const method = find_method(run.method());
  std::string name = run.method();
  for (const std::string& column : columns) {
    const std::string value = requested_value(run, without_prefix(column));
    // methods have different default contact laws
    const bool is_default_contact = without_prefix(column) == "contact" && run.text("set.contact").empty() &&
                                    method && value == method->contact.name;
    if (!value.empty() && !is_default_contact) name += fmt::format(", {}={}", without_prefix(column), value);
  }
  return name;
}

}  // namespace taut::cli
