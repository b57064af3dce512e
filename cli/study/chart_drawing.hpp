#pragma once

#include <string>

#include "cli/study/chart.hpp"
#include "cli/study/gnuplot.hpp"

namespace taut::cli {

/// A block per series.
std::string chart_data(const Chart& chart);
/// Work-precision diagram. Runs without an error form a strip at the top. Throws UsageError for too many series.
std::string chart_script(const Chart& chart, const PlotFiles& files);

}  // namespace taut::cli
