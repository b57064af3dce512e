#pragma once

#include <string>

#include "cli/study/gnuplot.hpp"
#include "cli/study/stability_map.hpp"

namespace taut::cli {

/// A block per verdict.
std::string map_data(const StabilityMap& map);
/// A coloured cell per run with the time of failure.
std::string map_script(const StabilityMap& map, const PlotFiles& files);

}  // namespace taut::cli
