#pragma once

#include <optional>
#include <string>

#include "cli/sweep/plan.hpp"
#include "cli/text/test_report.hpp"
#include "engine/judge/verdict.hpp"

namespace taut::cli {

/// Text of results.json; cli/COMMANDS.md describes its keys. A run without a result has no keys after "folder"; an
/// interrupted run has the values of its completed part. All runs are in grid order. Keys that vary between
/// repetitions, such as "seconds", come last.
std::string results_json(const SweepPlan& plan);
/// Same contents as a tree; with `index`, only this run.
Json results_tree(const SweepPlan& plan, std::optional<int> index = {});

/// results.csv: a row per run, in the format of RFC 4180. Columns are paths in results.json: "set.v0",
/// "measures.period.value". A missing value is an empty cell.
std::string results_csv(const SweepPlan& plan);

/// Writes both files atomically into the sweep's folder. Throws OutputError.
void write_results(const SweepPlan& plan);

/// Run as a test: failed if its verdict is `fail_on` or worse, an error without a result.
TestCase test_case(const SweepRun& run, const std::optional<Verdict>& fail_on);

/// "fractured since 0.0031 s", "interrupted", ...
std::string outcome(const SweepRun& run);
/// Settings, verdict and measures of each run, as text.
std::string results_table(const SweepPlan& plan);

}  // namespace taut::cli
