#include "cli/sweep/results.hpp"

#include <algorithm>
#include <array>

#include "cli/study/csv.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/build_info.hpp"
#include "cli/system/provenance.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

constexpr std::array left_out = {"taut", "format", "provenance"};  // from run.json
constexpr std::array times = {"threads", "machine", "seconds", "particle_steps_per_second"};

std::string status(const SweepRun& run) {
  if (run.record.is_object()) return run.record.find("status")->text();
  return run.state == SweepRunState::broken ? "error" : "to do";
}

Json run_json(const SweepRun& run) {
  Json json;
  json["index"] = run.index;
  json["set"] = Json::object();
  for (const Setting& s : run.settings) json["set"][s.name] = number_or_text(s.value);
  json["status"] = status(run);
  json["message"] = run.problem.empty() ? Json() : Json(run.problem);
  json["folder"] = run.folder;
  if (!run.record.is_object()) return json;
  const auto is_of = [](const auto& keys, const std::string& key) {
    return std::ranges::count(keys, key) > 0;
  };
  for (const auto& [key, value] : run.record.members())
    if (!is_of(left_out, key) && !is_of(times, key) && !json.find(key)) json[key] = value;
  for (const char* key : times) {
    const Json* time = run.record.find(key);
    json[key] = time ? *time : Json();
  }
  return json;
}

/// Leaves of a tree with their paths.
using Cells = std::vector<Json::Member>;

void flatten(const Json& value, const std::string& path, Cells& cells) {
  if (!value.is_object()) {
    cells.emplace_back(path, value);
    return;
  }
  for (const auto& [key, inner] : value.members())
    flatten(inner, path.empty() ? key : path + "." + key, cells);
}

/// A new column follows its predecessor in its row.
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

const Json* find(const Json& run, std::initializer_list<const char*> path) {
  const Json* value = &run;
  for (const char* key : path)
    if (value) value = value->find(key);
  return !value || value->is_null() ? nullptr : value;
}

std::string measure_cell(const SweepRun& run, const std::string& measure) {
  const Json* value = find(run.record, {"measures", measure.c_str(), "value"});
  return value && run.state == SweepRunState::done ? brief(value->number()) : "-";
}

/// Names without and with units.
std::vector<std::pair<std::string, std::string>> measures_of(const SweepPlan& plan) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const SweepRun& run : plan.runs) {
    const Json* measures = find(run.record, {"measures"});
    if (!measures) continue;
    for (const auto& [name, measure] : measures->members()) {
      const Json* found = find(measure, {"unit"});
      const std::string unit = found ? found->text() : "";
      all.emplace_back(name, unit.empty() || unit == "1" ? name : name + ", " + unit);
    }
    break;  // all runs have one scene
  }
  return all;
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
  TestCase test{text_of(run.settings), Result::error, run.problem.empty() ? outcome(run) : run.problem};
  if (run.state != SweepRunState::done) return test;
  const Json* verdict = find(run.record, {"verdict"});
  test.result =
      fail_on && verdict && find_verdict(verdict->text()) >= fail_on ? Result::failed : Result::passed;
  if (const Json* seconds = find(run.record, {"seconds"})) {
    test.seconds = 0;
    for (const auto& [part, value] : seconds->members())
      if (value.is_number()) *test.seconds += value.number();
  }
  return test;
}

std::string outcome(const SweepRun& run) {
  const Json* verdict = find(run.record, {"verdict"});
  if (!verdict || run.state != SweepRunState::done) return status(run);
  const std::string& name = verdict->text();
  const Json* since = find(run.record, {"since", name.c_str()});
  return name + (since ? " since " + brief(since->number()) + " s" : "");
}

std::string results_table(const SweepPlan& plan) {
  const auto measures = measures_of(plan);
  std::vector<std::vector<std::string>> rows{{"run"}};
  for (const Swept& s : plan.swept)
    rows[0].push_back(s.unit.empty() || s.unit == "1" ? s.name : s.name + ", " + s.unit);
  rows[0].emplace_back("verdict");
  for (const auto& measure : measures) rows[0].push_back(measure.second);
  for (const SweepRun& run : plan.runs) {
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(std::to_string(run.index));
    for (const Swept& s : plan.swept) {
      const auto setting = std::ranges::find(run.settings, s.name, &Setting::name);
      row.push_back(setting == run.settings.end() ? "-" : setting->value);
    }
    row.push_back(outcome(run));
    for (const auto& measure : measures) row.push_back(measure_cell(run, measure.first));
  }
  return in_columns(rows);
}

}  // namespace taut::cli
