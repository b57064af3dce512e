#pragma once

#include <string>

#include "cli/study/chart.hpp"

namespace taut::cli {

/// For a terminal: order of convergence, finest run and number of unstable runs of each series.
std::string orders_table(const Chart& chart);
/// Markdown: error of each series at each spacing.
std::string markdown(const Chart& chart);
/// Markdown: cheapest run of each series within some accuracies; empty where errors or costs do not allow it.
std::string markdown_of_prices(const Chart& chart);
/// JSON with all points.
std::string chart_json(const Chart& chart);

/// "error of period, % of the reference": the quantity on the error axis.
std::string error_label(const Chart& chart);
/// Notes for the whole chart: fixed settings, reference, machine.
std::vector<std::string> footnotes(const Chart& chart);

}  // namespace taut::cli
