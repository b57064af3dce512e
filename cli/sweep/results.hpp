#pragma once

#include <optional>
#include <string>

#include "cli/sweep/plan.hpp"
#include "cli/text/test_report.hpp"
#include "engine/judge/verdict.hpp"

namespace taut::cli {

/// results.json (cli/COMMANDS.md). A run without a result has no keys after "folder"; an interrupted run describes
/// its completed part. Keys that vary between repetitions come last.
std::string results_json(const SweepPlan& plan);
/// `index`: only this run.
Json results_tree(const SweepPlan& plan, std::optional<int> index = {});

/// Columns are paths in results.json: "set.v0", "measures.period.value".
std::string results_csv(const SweepPlan& plan);

/// Writes both atomically. Throws OutputError.
void write_results(const SweepPlan& plan);

/// Failed: verdict `fail_on` or worse; error: no result.
TestCase test_case(const SweepRun& run, const std::optional<Verdict>& fail_on);

/// "fractured since 0.0031 s", "interrupted", ...
std::string outcome(const SweepRun& run);
std::string results_table(const SweepPlan& plan);

}  // namespace taut::cli
