#pragma once

#include <string>

#include "cli/study/gnuplot.hpp"
#include "cli/study/stability_map.hpp"

namespace taut::cli {

std::string map_data(const StabilityMap& map);
std::string map_script(const StabilityMap& map, const PlotFiles& files);

}  // namespace taut::cli
