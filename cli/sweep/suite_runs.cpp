#include "cli/sweep/suite_runs.hpp"

#include <algorithm>

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

/// In file order.
std::vector<SuiteEntry> chosen(const SuiteFile& suite, const SuiteOptions& options) {
  std::vector<std::string> names;
  for (const SuiteEntry& entry : suite.entries) names.push_back(entry.name);
  for (const std::string& given : options.only)
    if (std::ranges::find(names, given) == names.end())
      throw UsageError(unknown_name("entry", given, names) + " in " + suite.path.string());
  std::vector<SuiteEntry> entries = suite.entries;
  if (!options.only.empty())
    std::erase_if(entries, [&](const SuiteEntry& entry) {
      return std::ranges::find(options.only, entry.name) == options.only.end();
    });
  if (!options.update) return entries;
  for (const SuiteEntry& entry : entries)
    if (entry.is_control() && !options.only.empty())
      throw UsageError("'" + entry.name + "' is a control without a baseline of its own; update '" +
                       entry.differs_from + "', from which it differs");
  std::erase_if(entries, [](const SuiteEntry& entry) { return entry.is_control(); });
  return entries;
}

SweepRequest request_of(const SuiteFile& suite, const SuiteEntry& entry, const Baseline& baseline,
                        const SuiteOptions& options) {
  SweepRequest request;
  request.title = entry.name;
  request.file = suite.path;
  request.base.scene = entry.scene;
  request.base.drawing.values = entry.drawing;
  request.base.threads = options.threads;
  request.base.keeps_look = options.update;
  if (!options.update) request.base.look = baseline.look();
  request.rows = {entry.settings};
  request.folder = options.out;
  return request;
}

/// Adds the entry to errors without a place.
SweepRun planned_run(const SuiteFile& suite, const SuiteEntry& entry, const Baseline& baseline,
                     const SuiteOptions& options) {
  try {
    SweepRun run = plan_sweep(request_of(suite, entry, baseline, options)).runs.front();
    run.options.out = (options.out / entry.name).string();
    run.scene = make_plan(run.options).scene_text();
    run.folder = entry.name;
    run.forced = true;  // the program may have changed
    run.forget();
    return run;
  } catch (const SceneError& error) {
    if (error.file != suite.path.string() || error.line > 0) throw;
    throw SceneError(error.file, entry.place.line, entry.place.column, "entry." + entry.name, error.what());
  }
}

void refuse_missing(const std::vector<PlannedEntry>& entries) {
  std::vector<std::string> names;
  for (const PlannedEntry& planned : entries)
    if (!planned.baseline.exists() && std::ranges::find(names, planned.entry.owner()) == names.end())
      names.push_back(planned.entry.owner());
  if (names.empty()) return;
  throw UsageError("there is no baseline of " + join(names) + " in '" +
                   entries.front().baseline.path().parent_path().string() +
                   "'; create it with --update --only " + join(names, ","));
}

std::string problem_of(const SweepRun& run) {
  if (run.state != SweepRunState::done) return run.problem.empty() ? "the run is not finished" : run.problem;
  return run.record->status == RunRecord::Status::failed ? run.record->reason : "";
}

EntryResult result_of(const PlannedEntry& planned, const FolderDifference& difference) {
  using enum EntryResult;
  if (planned.entry.is_control()) return difference.alike() ? control_alike : control_differs;
  if (!difference.alike()) return different;
  return number_of_warnings(difference, planned.entry.warn) > 0 ? warning : alike;
}

}  // namespace

render::DifferenceLimit PlannedEntry::limit() const { return limit_of({entry.fail}); }

std::string_view name(EntryResult result) {
  switch (result) {
    case EntryResult::alike:
      return "alike";
    case EntryResult::warning:
      return "alike, with a warning";
    case EntryResult::different:
      return "different";
    case EntryResult::control_differs:
      return "differs, as a control must";
    case EntryResult::control_alike:
      return "alike, but a control must differ";
    case EntryResult::updated:
      return "updated";
    case EntryResult::no_result:
      return "no result";
  }
  return "";
}

bool EntryOutcome::passed() const {
  using enum EntryResult;
  return result != different && result != control_alike && result != no_result;
}

std::vector<PlannedEntry> plan_suite(const SuiteFile& suite, const SuiteOptions& options,
                                     bool needs_baselines) {
  std::vector<PlannedEntry> entries;
  const fs::path baselines = options.baselines.value_or(suite.baselines);
  for (const SuiteEntry& entry : chosen(suite, options)) {
    const Baseline baseline(baselines / entry.owner());
    baseline.check(options.out, options.update);
    entries.push_back({entry, baseline, planned_run(suite, entry, baseline, options)});
    entries.back().run.index = static_cast<int>(entries.size()) - 1;
  }
  if (needs_baselines && !options.update) refuse_missing(entries);
  return entries;
}

EntryOutcome compare_entry(const PlannedEntry& planned) {
  EntryOutcome outcome{&planned};
  outcome.problem = problem_of(planned.run);
  if (!outcome.problem.empty()) return outcome;
  try {
    outcome.difference = compare_folders(planned.baseline.path(),
                                         RunFolder(*planned.run.options.out).frames(), planned.limit());
    outcome.result = result_of(planned, outcome.difference);
  } catch (const UsageError& error) {
    outcome.problem = error.what();
  }
  return outcome;
}

std::vector<EntryOutcome> update_entries(const std::vector<PlannedEntry>& entries) {
  std::vector<EntryOutcome> outcomes;
  for (const PlannedEntry& planned : entries) {
    outcomes.push_back({&planned});
    outcomes.back().problem = problem_of(planned.run);
  }
  const bool all = std::ranges::all_of(outcomes, &std::string::empty, &EntryOutcome::problem);
  for (EntryOutcome& outcome : outcomes) {
    if (!all && outcome.problem.empty()) outcome.problem = "not updated, since another run has no result";
    if (!all) continue;
    outcome.updated = outcome.planned->baseline.replace_by(RunFolder(*outcome.planned->run.options.out));
    outcome.result = EntryResult::updated;
  }
  return outcomes;
}

}  // namespace taut::cli
