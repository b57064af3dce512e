#pragma once

#include <string>

#include "cli/study/chart.hpp"
#include "cli/study/gnuplot.hpp"

namespace taut::cli {

/// A block per series, from coarse to fine.
std::string chart_data(const Chart& chart);
/// Work-precision diagram with slopes of order 1 and 2; runs without an error form a strip at the top. Throws
/// UsageError for too many series.
std::string chart_script(const Chart& chart, const PlotFiles& files);

}  // namespace taut::cli
