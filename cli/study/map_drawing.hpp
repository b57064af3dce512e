#pragma once

#include <string>

#include "cli/study/gnuplot.hpp"
#include "cli/study/stability_map.hpp"

namespace taut::cli {

/// The cells of a map as gnuplot reads them, a block for each verdict.
std::string map_data(const StabilityMap& map);
/// The gnuplot script: a coloured cell for each run with the time of its failure.
std::string map_script(const StabilityMap& map, const PlotFiles& files);

}  // namespace taut::cli
