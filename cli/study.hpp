#pragma once

#include <string>
#include <vector>

#include "cli/chart.hpp"
#include "cli/command.hpp"
#include "cli/gnuplot.hpp"

namespace taut {

/// Draws a chart from results.csv files, and prints the orders of convergence and where the picture is. Gives
/// the exit code. Throws UsageError and OutputError.
int draw_chart(const std::vector<std::string>& results, const ChartRequest& request, const PlotFiles& files,
               Streams streams);

}  // namespace taut
