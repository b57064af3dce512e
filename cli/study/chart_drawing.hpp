#pragma once

#include <string>

#include "cli/study/chart.hpp"
#include "cli/study/gnuplot.hpp"

namespace taut::cli {

/// The numbers of a chart as gnuplot reads them: a block for each series, a line for each run, coarse to
/// fine.
std::string chart_data(const Chart& chart);
/// The gnuplot script: log error on x, log cost on y, a line with markers for each series, runs that were not
/// stable crossed out, those without an error in a strip at the right, slopes of order 1 and 2 behind. Throws
/// UsageError for more series than can be told apart.
std::string chart_script(const Chart& chart, const PlotFiles& files);

}  // namespace taut::cli
