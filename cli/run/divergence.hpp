#pragma once

#include <string>

#include "engine/diagnostics/balance.hpp"
#include "engine/error.hpp"
#include "engine/simulation.hpp"

namespace taut::cli {

/// What the user is told of a run that ended in an error of the solver.
std::string describe_divergence(const NumericalError& error);
/// The same of a state that was judged to have diverged: its energy, and the particle to look at first.
std::string describe_divergence(const Snapshot& now, const Balance& sums);

}  // namespace taut::cli
