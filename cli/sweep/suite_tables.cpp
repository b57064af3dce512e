#include "cli/sweep/suite_tables.hpp"

#include <algorithm>
#include <array>

#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;
using Rows = std::vector<std::vector<std::string>>;

std::string number(std::size_t value) { return std::to_string(value); }

std::size_t number_different(const FolderDifference& d) {
  return static_cast<std::size_t>(d.different()) + d.only_in_a.size() + d.only_in_b.size();
}

std::vector<std::string> row_of(const EntryOutcome& outcome) {
  const std::string& entry = outcome.planned->entry.name;
  const std::string result(name(outcome.result));
  if (outcome.result == EntryResult::no_result) return {entry, result + ": " + outcome.problem};
  if (outcome.result == EntryResult::updated)
    return {entry, result + ": " + number(outcome.updated) + " frames in " +
                       outcome.planned->baseline.path().string()};
  const FolderDifference& d = outcome.difference;
  return {entry,
          result,
          number(d.pictures.size()),
          number(number_different(d)),
          d.worst,
          brief(d.at_worst.greatest)};
}

void add_frames(const EntryOutcome& outcome, Rows& rows) {
  const auto& [entry, baseline, run] = *outcome.planned;
  const FolderDifference& difference = outcome.difference;
  for (const PictureDifference& picture : difference.pictures) {
    const bool warning = warns(picture, entry.warn);
    if (picture.alike && !warning) continue;
    const render::ImageDifference& d = picture.difference;
    rows.push_back({entry.name, picture.name, warning ? "warning" : "different", percent(d.share),
                    brief(d.greatest),
                    percent(d.densest) + " at " + std::to_string(d.column) + "," + std::to_string(d.row)});
  }
  for (const std::string& name : difference.only_in_a)
    rows.push_back({entry.name, name, "only in the baseline"});
  for (const std::string& name : difference.only_in_b) rows.push_back({entry.name, name, "only in the run"});
}

std::string summary(const std::vector<EntryOutcome>& outcomes) {
  const auto failed = std::ranges::count(outcomes, false, &EntryOutcome::passed);
  if (outcomes.size() == 1) return failed == 0 ? "the entry passed\n" : "the entry failed\n";
  const std::string all = number(outcomes.size()) + " entries";
  return failed == 0 ? "all of " + all + " passed\n" : std::to_string(failed) + " of " + all + " failed\n";
}

std::string control_text(const EntryOutcome& outcome) {
  const SuiteEntry& entry = outcome.planned->entry;
  return entry.name + ": all frames are like the baseline of '" + entry.differs_from +
         "', from which a control must differ";
}

}  // namespace

std::string list_of_entries(const std::vector<PlannedEntry>& entries, std::optional<std::size_t> columns) {
  Rows rows{{"entry", "scene", "settings", "baseline"}};
  for (const auto& [entry, baseline, run] : entries) {
    const std::string own =
        baseline.exists() ? number(picture_names(baseline.path()).size()) + " frames" : "none";
    rows.push_back({entry.name, entry.scene, text_of(entry.settings),
                    entry.is_control() ? "must differ from " + entry.differs_from : own});
  }
  return in_columns(rows, 0, columns);
}

std::string table_of_outcomes(const std::vector<EntryOutcome>& outcomes, std::optional<std::size_t> columns) {
  Rows rows{{"entry", "result", "frames", "different", "worst", "ΔE*ab"}};
  Rows frames{{"entry", "frame", "", "visibly different", "ΔE*ab", "densest window"}};
  for (const EntryOutcome& outcome : outcomes) {
    rows.push_back(row_of(outcome));
    if (!outcome.planned->entry.is_control()) add_frames(outcome, frames);
  }
  std::string text = in_columns(rows, 0, columns) + "\n";
  if (frames.size() > 1) text += in_columns(frames, 0, columns) + "\n";
  return text + summary(outcomes);
}

Json entry_json(const PlannedEntry& planned, const EntryOutcome* outcome) {
  const auto& [entry, baseline, run] = planned;
  Json settings = Json::object();
  for (const Setting& setting : entry.settings) settings[setting.name] = number_or_text(setting.value);
  Json json{
      {"name", entry.name},      {"scene", entry.scene},
      {"settings", settings},    {"differs_from", entry.is_control() ? Json(entry.differs_from) : Json()},
      {"run", *run.options.out}, {"baseline", baseline.path().string()}};
  if (!outcome) return json;
  json["result"] = name(outcome->result);
  json["passed"] = outcome->passed();
  json["problem"] = outcome->problem;
  json["warnings"] = number_of_warnings(outcome->difference, entry.warn);
  json["pictures"] = pictures_json(outcome->difference);
  return json;
}

TestReport suite_report(const SuiteFile& suite, const std::vector<EntryOutcome>& outcomes) {
  using Result = TestCase::Result;
  TestReport report{"snapshot", suite.title, {}};
  for (const EntryOutcome& outcome : outcomes) {
    const SuiteEntry& entry = outcome.planned->entry;
    if (outcome.result == EntryResult::no_result)
      report.cases.push_back({entry.name, Result::error, entry.name + ": " + outcome.problem});
    else if (outcome.result == EntryResult::updated)
      report.cases.push_back({entry.name});
    else if (entry.is_control())
      report.cases.push_back(
          {entry.name, outcome.passed() ? Result::passed : Result::failed, control_text(outcome)});
    else
      for (TestCase& each : test_cases(outcome.difference, outcome.planned->baseline.path().string(),
                                       *outcome.planned->run.options.out)) {
        each.name = entry.name + "/" + each.name;
        each.text = entry.name + "/" + each.text;
        report.cases.push_back(std::move(each));
      }
  }
  return report;
}

SuiteRecord record_of(const SuiteFile& suite, const SuiteOptions& options,
                      const std::vector<EntryOutcome>& outcomes) {
  SuiteRecord record{suite.title, suite.path.string(), {}};
  const fs::path folder = fs::weakly_canonical(fs::absolute(options.out));
  for (const EntryOutcome& outcome : outcomes) {
    const auto& [entry, baseline, run] = *outcome.planned;
    const fs::path path = fs::weakly_canonical(fs::absolute(baseline.path())).lexically_relative(folder);
    record.entries.push_back({entry.name, path, entry.differs_from, entry.warn, entry.fail, outcome.problem});
  }
  return record;
}

}  // namespace taut::cli
