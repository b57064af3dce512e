#pragma once

#include <string>

#include "cli/study/chart.hpp"
#include "cli/study/gnuplot.hpp"

namespace taut::cli {

/// The numbers of a chart as gnuplot reads them: a block for each series, a line for each run, coarse to
/// fine.
std::string chart_data(const Chart& chart);
/// The gnuplot script of a work-precision diagram: log cost to the right, log error up, a line with markers
/// for each series, thin where a run was not stable, whose marker is open with a cross beside it. Runs
/// without an error stand above, a row for each series; slopes of order 1 and 2 behind. Throws UsageError for
/// more series than can be told apart.
std::string chart_script(const Chart& chart, const PlotFiles& files);

}  // namespace taut::cli
