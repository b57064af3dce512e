#pragma once

#include <string>

#include "cli/study/chart.hpp"

namespace taut::cli {

/// Table for a terminal: order of convergence, finest run and number of unstable runs of each series.
std::string orders_table(const Chart& chart);
/// Markdown: error of each series at each spacing.
std::string markdown(const Chart& chart);
/// Markdown: cheapest run of each series for several accuracies; empty unless errors are shares and costs are
/// seconds.
std::string markdown_of_prices(const Chart& chart);
std::string chart_json(const Chart& chart);

/// Label of the error axis: "error of period, % of the reference".
std::string error_label(const Chart& chart);
/// Notes for the whole chart: fixed settings, reference, machine.
std::vector<std::string> footnotes(const Chart& chart);

}  // namespace taut::cli
