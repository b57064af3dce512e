#pragma once

#include <optional>
#include <string>

#include "cli/sweep/plan.hpp"
#include "cli/text/test_report.hpp"
#include "engine/judge/verdict.hpp"

namespace taut::cli {

/// results.json of a sweep:
///
///     { "taut": "0.2.0", "format": 1, "title": "...", "scene": "colliding-rings",
///       "swept": [{"name": "v0", "unit": "c0", "help": "..."}, {"name": "method", ...}],
///       "fixed": {"until": 0.3},                                     what was set for all runs
///       "runs": [
///         { "index": 0, "set": {"v0": 0.02, "method": "og"},         as the grid has it: numbers or texts
///           "status": "finished|failed|interrupted|to do|error",     failed: diverged; error: see message
///           "message": "...", "folder": "v0=0.02_method=og",         inside the sweep's folder
///           what run.json says of the run, in its order, without "taut", "format", "status" and
///           "provenance"; last of all what
///           differs from time to time: "threads", "machine", "seconds", "particle_steps_per_second" },
///         ... ] }
///
/// All runs of the grid are there, in its order, in whatever order they ended. A run without a result ("to
/// do", "error") has no keys behind "folder"; one that was interrupted has those of the part that was run.
std::string results_json(const SweepPlan& plan);
/// The same as a tree; with `index`, only this run.
Json results_tree(const SweepPlan& plan, std::optional<int> index = {});

/// results.csv: "runs" of results.json, a row each. The name of a column is the path in there:
/// "set.v0", "verdict", "since.fractured", "measures.period.value", "seconds.solve", ... A cell without a
/// value is empty; one with a comma or a quote stands in quotes, as RFC 4180 has it.
std::string results_csv(const SweepPlan& plan);

/// Both, whole, into the sweep's folder. Throws OutputError.
void write_results(const SweepPlan& plan);

/// The run as a test: failed if its verdict is `fail_on` or worse, an error without a result.
TestCase test_case(const SweepRun& run, const std::optional<Verdict>& fail_on);

/// "fractured since 0.0031 s", "interrupted", "error", ...
std::string outcome(const SweepRun& run);
/// What `taut sweep` prints at its end: settings, verdict and measures of each run.
std::string results_table(const SweepPlan& plan);

}  // namespace taut::cli
