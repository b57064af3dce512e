#pragma once

#include <string>

#include "cli/study/chart.hpp"

namespace taut::cli {

/// For people: each series with its errors' order, its finest run and its unstable ones.
std::string orders_table(const Chart& chart);
/// Error of each series at each spacing, for a page.
std::string markdown_table(const Chart& chart);
/// Everything, as a tree.
std::string chart_json(const Chart& chart);

/// "error of period, % of the reference"; what the errors are.
std::string error_label(const Chart& chart);
/// What holds for the whole chart: what was fixed, the reference, the machine.
std::vector<std::string> footnotes(const Chart& chart);

}  // namespace taut::cli
