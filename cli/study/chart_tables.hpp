#pragma once

#include <string>

#include "cli/study/chart.hpp"

namespace taut::cli {

std::string orders_table(const Chart& chart);
/// Errors by series and spacing.
std::string markdown(const Chart& chart);
/// Cheapest run of each series by accuracy; may be empty.
std::string markdown_of_prices(const Chart& chart);
std::string chart_json(const Chart& chart);

/// "error of period, % of the reference". `share`: unit of errors without a unit.
std::string error_label(const Chart& chart, std::string_view share = "%");
std::vector<std::string> footnotes(const Chart& chart);

}  // namespace taut::cli
