#pragma once

#include <string>

#include "cli/study/chart.hpp"
#include "cli/study/gnuplot.hpp"

namespace taut::cli {

/// One block per series, one line per run, coarse to fine.
std::string chart_data(const Chart& chart);
/// Work-precision diagram: log error over log cost, a line per series, slopes of order 1 and 2. Unstable runs have
/// thin lines and crossed open markers. Runs without an error are in a strip at the top. Throws UsageError for too
/// many series.
std::string chart_script(const Chart& chart, const PlotFiles& files);

}  // namespace taut::cli
