#include "cli/sweep/results.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "cli/study/csv.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/build_info.hpp"
#include "cli/system/provenance.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

/// First run, with the cost of the median run.
RunRecord median(const SweepRun& run) {
  RunRecord record = *run.record;
  if (run.repetitions.empty()) return record;
  const RunRecord& median = *run.cost()->median;
  record.seconds = median.seconds;
  record.other_load = median.other_load;
  return record;
}

Json run_json(const SweepRun& run) {
  Json json;
  json["index"] = run.index;
  json["set"] = Json::object();
  for (const Setting& s : run.settings) json["set"][s.name] = number_or_text(s.value);
  Json results = run.record ? to_results(median(run)) : Json::object();
  if (const auto cost = run.cost(); cost && !run.repetitions.empty())
    results["repeated"] = {{"runs", cost->runs}, {"cpu_spread", cost->spread}};
  const Json* status = results.find("status");
  json["status"] = status ? *status : Json(run.state == SweepRunState::broken ? "error" : "to do");
  const std::string& problem = run.first_unfinished().problem;
  json["message"] = problem.empty() ? Json() : Json(problem);
  json["folder"] = run.folder;
  return json.with(results);
}

using Cells = std::vector<Json::Member>;

void flatten(const Json& value, const std::string& path, Cells& cells) {
  if (!value.is_object()) {
    cells.emplace_back(path, value);
    return;
  }
  for (const auto& [key, inner] : value.members())
    flatten(inner, path.empty() ? key : fmt::format("{}.{}", path, key), cells);
}

/// A column that earlier rows lack follows its predecessor.
std::vector<std::string> columns_of(const std::vector<Cells>& rows) {
  std::vector<std::string> columns;
  for (const Cells& row : rows) {
    auto place = columns.begin();
    for (const auto& cell : row) {
      const auto found = std::ranges::find(columns, cell.first);
      place = (found != columns.end() ? found : columns.insert(place, cell.first)) + 1;
    }
  }
  return columns;
}

std::string cell_of(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_text()) return csv_cell(value.text());
  return value.is_float() ? exact(value.number()) : csv_cell(value.dump());
}

/// All runs have the same scene.
std::vector<MeasureResult> measures_of(const SweepPlan& plan) {
  const auto run = std::ranges::find_if(plan.runs, [](const SweepRun& r) { return r.record.has_value(); });
  return run == plan.runs.end() ? std::vector<MeasureResult>() : run->record->measures;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{}, {}", name, unit);
}

}  // namespace

Json results_tree(const SweepPlan& plan, std::optional<int> index) {
  Json json;
  json["taut"] = build_info.version;
  json["format"] = format_of("results.json");
  json["title"] = plan.title;
  json["scene"] = plan.scene;
  json["swept"] = Json::array();
  for (const Swept& s : plan.swept) json["swept"].add({{"name", s.name}, {"unit", s.unit}, {"help", s.help}});
  json["fixed"] = Json::object();
  for (const Setting& s : plan.fixed) json["fixed"][s.name] = number_or_text(s.value);
  json["runs"] = Json::array();
  for (const SweepRun& run : plan.runs)
    if (!index || run.index == *index) json["runs"].add(run_json(run));
  return json;
}

std::string results_json(const SweepPlan& plan) { return results_tree(plan).dump(2) + "\n"; }

std::string results_csv(const SweepPlan& plan) {
  std::vector<Cells> rows;
  for (const SweepRun& run : plan.runs) flatten(run_json(run), "", rows.emplace_back());
  const std::vector<std::string> columns = columns_of(rows);
  std::string text;
  for (const std::string& column : columns) text.append(csv_cell(column)).append(",");
  text.back() = '\n';
  for (const Cells& row : rows) {
    for (const std::string& column : columns) {
      const auto cell = std::ranges::find(row, column, &Cells::value_type::first);
      if (cell != row.end()) text.append(cell_of(cell->second));
      text.append(",");
    }
    text.back() = '\n';
  }
  return text;
}

void write_results(const SweepPlan& plan) {
  write_atomically(plan.folder / "results.csv", results_csv(plan), Durability::on_disk);
  write_atomically(plan.folder / "results.json", results_json(plan), Durability::on_disk);
}

TestCase test_case(const SweepRun& run, const std::optional<Verdict>& fail_on) {
  using Result = TestCase::Result;
  const SweepRun& unfinished = run.first_unfinished();
  TestCase test{text_of(run.settings), Result::error,
                unfinished.problem.empty() ? outcome(unfinished) : unfinished.problem};
  if (unfinished.state != SweepRunState::done) return test;
  test.result = fail_on && run.record->verdict >= fail_on ? Result::failed : Result::passed;
  test.seconds = run.seconds;
  return test;
}

std::string outcome(const SweepRun& run) {
  if (!run.record || !run.record->verdict || run.state != SweepRunState::done)
    return run_json(run).find("status")->text();
  const auto since = run.record->since.find(*run.record->verdict);
  const std::string verdict(name(*run.record->verdict));
  return since == run.record->since.end() ? verdict
                                          : fmt::format("{} since {} s", verdict, brief(since->second));
}

std::string results_table(const SweepPlan& plan) {
  const std::vector<MeasureResult> measures = measures_of(plan);
  std::vector<std::vector<std::string>> rows{{"run"}};
  for (const Swept& s : plan.swept) rows[0].push_back(with_unit(s.name, s.unit));
  rows[0].emplace_back("verdict");
  for (const MeasureResult& measure : measures) rows[0].push_back(with_unit(measure.name, measure.unit));
  const bool repeated = !plan.runs.empty() && !plan.runs.front().repetitions.empty();
  if (repeated) rows[0].insert(rows[0].end(), {"median CPU, s", "spread", "runs"});
  for (const SweepRun& run : plan.runs) {
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(std::to_string(run.index));
    for (const Swept& s : plan.swept) {
      const auto setting = std::ranges::find(run.settings, s.name, &Setting::name);
      row.push_back(setting == run.settings.end() ? "-" : setting->value);
    }
    row.push_back(outcome(run));
    for (const MeasureResult& measure : measures) {
      const auto value =
          run.state == SweepRunState::done ? run.record->measure(measure.name).value : std::nullopt;
      row.push_back(value ? brief(*value) : "-");
    }
    if (!repeated) continue;
    const auto cost = run.cost();
    row.insert(row.end(), {cost ? brief(cost->median->seconds.cpu) : "-", cost ? percent(cost->spread) : "-",
                           std::to_string(cost ? cost->runs : 0)});
  }
  return in_columns(rows);
}

}  // namespace taut::cli
