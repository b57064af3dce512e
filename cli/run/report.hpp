#pragma once

#include <string>

#include "cli/run/run.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"

namespace taut::cli {

/// What `taut run` prints when a run has ended: the verdict, the measures beside their references, the speed
/// and where the output is.
std::string run_report(const RunPlan& plan, const RunResult& result);

/// What a run tells the shell. `fail_on`: the mildest verdict that fails; without it only divergence does.
int exit_code(const RunResult& result, const std::optional<Verdict>& fail_on = {});

/// Of bodies whose particles weigh more or less than their shape, by 2 % or more; mostly empty.
std::string describe_masses(const Scene& scene, const Snapshot& start);

/// Of two bodies that may hold together as one under the contact law `sph`, since their faces are less than a spacing
/// apart at the start and within the `support` of the kernel, m; mostly empty.
std::string describe_welds(const Scene& scene, const Snapshot& start, double support);

/// Of contacts that hold energy before anything has moved; mostly empty.
std::string describe_start_in_contact(const Scene& scene, const Snapshot& start);

/// What the user is told of a run that ended in an error of the solver.
std::string describe_divergence(const NumericalError& error);
/// The same of a state that was judged to have diverged: its energy, and the particle to look at first.
std::string describe_divergence(const Snapshot& now, const Balance& sums);

}  // namespace taut::cli
