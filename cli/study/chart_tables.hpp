#pragma once

#include <string>

#include "cli/study/chart.hpp"

namespace taut::cli {

/// Order of convergence, finest run and unstable runs of each series.
std::string orders_table(const Chart& chart);
std::string markdown(const Chart& chart);
/// Cheapest run of each series within some errors; empty unless errors are shares and costs seconds.
std::string markdown_of_prices(const Chart& chart);
std::string chart_json(const Chart& chart);

/// "error of period, % of the reference".
std::string error_label(const Chart& chart);
std::vector<std::string> footnotes(const Chart& chart);

}  // namespace taut::cli
