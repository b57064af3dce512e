#pragma once

#include <string>

#include "cli/study/chart.hpp"
#include "cli/study/gnuplot.hpp"

namespace taut::cli {

/// Data for gnuplot: a block per series, a line per run, from coarse to fine.
std::string chart_data(const Chart& chart);
/// Gnuplot script of a work-precision diagram (log error over log cost) with a line per series, and slopes of order 1
/// and 2. Unstable runs have thin lines and crossed open markers; runs without an error form a strip at the top.
/// Throws UsageError for too many series.
std::string chart_script(const Chart& chart, const PlotFiles& files);

}  // namespace taut::cli
