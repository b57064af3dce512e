#include "cli/study/stability_map.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "cli/text/markdown.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct SettingNames {
  std::vector<std::string> swept, all;
};

SettingNames names_of(const std::vector<StoredRun>& runs) {
  SettingNames names;
  std::map<std::string, std::set<std::string>> values;
  for (const StoredRun& run : runs)
    for (const auto& [column, value] : run.cells)
      if (column.starts_with(set_prefix) && column != "set.method") {
        const std::string name = column.substr(set_prefix.size());
        if (values[name].empty()) names.all.push_back(name);
        values[name].insert(value);
      }
  std::ranges::copy_if(names.all, std::back_inserter(names.swept),
                       [&](const std::string& name) { return values[name].size() > 1; });
  return names;
}

}  // namespace

std::string swept_parameter(const std::vector<StoredRun>& runs, const std::string& wanted,
                            std::string_view option) {
  const auto [swept, all] = names_of(runs);
  if (!wanted.empty()) {
    if (std::ranges::find(all, wanted) == all.end())
      throw UsageError(all.empty()
                           ? fmt::format("only the method was swept, so '{}' cannot be mapped", wanted)
                           : unknown_name("swept parameter", wanted, all));
    return wanted;
  }
  if (swept.size() == 1) return swept.front();
  if (swept.empty() && all.size() == 1) return all.front();
  if (swept.empty()) throw UsageError("only the method was swept; sweep a parameter, too");
  throw UsageError(fmt::format("several parameters were swept ({}); name one with {}", join(swept), option));
}

namespace {

void sort_numbers(std::vector<std::string>& values) {
  const auto number = [](const std::string& text) { return parsed<double>(text); };
  if (std::ranges::all_of(values, [&](const std::string& text) { return number(text).has_value(); }))
    std::ranges::stable_sort(values, {}, number);
}

std::size_t place_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  const auto place = static_cast<std::size_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return place;
}

MapCell cell_of(const StoredRun& run, const std::optional<ResultColumn>& measure) {
  MapCell cell{.verdict = "", .status = run.status, .since = {}};
  if (!run.has_result()) return cell;
  if (measure) cell.value = measure->number(run);
  if (!run.record.verdict) return cell;
  cell.verdict = run.verdict();
  const auto since = run.record.since.find(*run.record.verdict);
  if (since != run.record.since.end()) cell.since = since->second;
  return cell;
}

std::string cell_of_table(const MapCell& cell, const StabilityMap& map) {
  const std::string word = cell.verdict.empty() ? cell.status : cell.verdict;
  if (!map.measure) return cell.since ? fmt::format("{} {} s", word, brief(*cell.since)) : word;
  if (!cell.value) return fmt::format("- ({})", word);
  return fmt::format("{}{}{}", brief(*cell.value), map.measure->unit.empty() ? "" : " " + map.measure->unit,
                     cell.verdict == "stable" ? "" : fmt::format(" ({})", word));
}

std::vector<std::vector<std::string>> rows_of(const StabilityMap& map) {
  std::vector<std::vector<std::string>> rows{{map.label}};
  rows[0].insert(rows[0].end(), map.values.begin(), map.values.end());
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    rows.push_back({map.rows[r]});
    for (const auto& cell : map.cells[r]) rows.back().push_back(cell ? cell_of_table(*cell, map) : "-");
  }
  return rows;
}

}  // namespace

StabilityMap make_map(const StoredResults& results, const MapRequest& request) {
  StabilityMap map;
  const std::string parameter = swept_parameter(results.runs, request.parameter, "--parameter");
  const std::string x = std::string(set_prefix) + parameter;
  const std::vector<std::string> columns = distinguishing_columns(results.runs, x);
  if (!request.measure.empty()) map.measure = find_result_column(results, request.measure);
  map.title = results.title;
  map.scene = results.scene;
  map.parameter = parameter;
  map.label = results.label(parameter);
  for (const StoredRun& run : results.runs)
    if (const std::string value = run.text(x); !value.empty()) place_of(map.values, value);
  sort_numbers(map.values);
  for (const StoredRun& run : results.runs) {
    if (run.text(x).empty()) continue;
    const std::size_t row = place_of(map.rows, series_name(run, columns));
    if (row == map.cells.size()) map.cells.emplace_back(map.values.size());
    std::optional<MapCell>& cell = map.cells[row][place_of(map.values, run.text(x))];
    if (!cell || cell->verdict.empty()) cell = cell_of(run, map.measure);
  }
  const auto has_value = [](const std::optional<MapCell>& cell) { return cell && cell->value; };
  const auto has_values = [&](const auto& cells) { return std::ranges::any_of(cells, has_value); };
  if (map.measure && std::ranges::none_of(map.cells, has_values))
    throw UsageError(fmt::format("no run has a number in '{}'; choose another --measure", request.measure));
  return map;
}

std::string map_table(const StabilityMap& map) { return in_columns(rows_of(map)); }

std::string markdown(const StabilityMap& map) {
  std::vector<std::vector<std::string>> rows = rows_of(map);
  for (std::vector<std::string>& row : rows)
    if (&row != &rows.front()) row.front() = fmt::format("`{}`", row.front());
  const std::string content =
      map.measure ? map.measure->name : "verdict, and the time at which it first held";
  return fmt::format("**{}**: {}\n\n{}", map.title, content, markdown_table(rows));
}

Json to_json(const StabilityMap& map) {
  Json json{{"title", map.title}, {"scene", map.scene}, {"parameter", map.parameter}, {"label", map.label}};
  if (map.measure) json["measure"] = map.measure->name, json["unit"] = map.measure->unit;
  json["values"] = Json::array();
  for (const std::string& value : map.values) json["values"].add(number_or_text(value));
  json["rows"] = Json::array();
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    Json cells = Json::array();
    for (const auto& cell : map.cells[r]) {
      if (!cell) {
        cells.add(Json());
        continue;
      }
      Json one{{"status", cell->status},
               {"verdict", cell->verdict.empty() ? Json() : Json(cell->verdict)},
               {"since", cell->since}};
      if (map.measure) one["value"] = cell->value;
      cells.add(std::move(one));
    }
    json["rows"].add({{"name", map.rows[r]}, {"cells", cells}});
  }
  return json;
}

}  // namespace taut::cli
