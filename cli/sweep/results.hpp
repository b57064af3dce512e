#pragma once

#include <optional>
#include <string>

#include "cli/sweep/plan.hpp"
#include "cli/text/test_report.hpp"
#include "engine/judge/verdict.hpp"

namespace taut::cli {

/// See cli/COMMANDS.md.
std::string results_json(const SweepPlan& plan);
/// `index` selects a run.
Json results_tree(const SweepPlan& plan, std::optional<int> index = {});

/// Columns are paths: "measures.period.value". Missing values are empty.
std::string results_csv(const SweepPlan& plan);

/// Writes each file atomically. Throws OutputError.
void write_results(const SweepPlan& plan);

TestCase test_case(const SweepRun& run, const std::optional<Verdict>& fail_on);

/// "fractured since 0.0031 s"
std::string outcome(const SweepRun& run);
std::string results_table(const SweepPlan& plan);

}  // namespace taut::cli
