#pragma once

#include <optional>
#include <string>

#include "cli/sweep/plan.hpp"
#include "cli/text/test_report.hpp"
#include "engine/diagnostics/verdict.hpp"

namespace taut::cli {

/// results.json (cli/COMMANDS.md): all runs in grid order. A run without a result has no keys after "folder"; an
/// interrupted run has those of its completed part. Keys that vary between repetitions come last.
std::string results_json(const SweepPlan& plan);
/// The same as a tree; with `index`, only this run.
Json results_tree(const SweepPlan& plan, std::optional<int> index = {});

/// results.csv: a row per run. Column names are paths in results.json: "set.v0", "verdict", "measures.period.value".
std::string results_csv(const SweepPlan& plan);

/// Writes both files atomically. Throws OutputError.
void write_results(const SweepPlan& plan);

/// Failed: the verdict is `fail_on` or worse; error: no result.
TestCase test_case(const SweepRun& run, const std::optional<Verdict>& fail_on);

/// "fractured since 0.0031 s", "interrupted", "error", ...
std::string outcome(const SweepRun& run);
/// Final text of `taut sweep`.
std::string results_table(const SweepPlan& plan);

}  // namespace taut::cli
