#pragma once

#include <string>
#include <vector>

#include "cli/scene/toml_tree.hpp"
#include "cli/study/gnuplot.hpp"
#include "cli/study/stored_results.hpp"

namespace taut::cli {

struct HistoryColumn {
  std::string name, label;  // "tip", "tip, m"
  FilePlace place = {};     // in a study
};

/// Columns of history.csv of several runs, over time or over another column.
struct HistoryPlot {
  struct Curve {
    std::string name;
    std::string method;
    std::vector<std::vector<double>> rows;  // x, then the columns; NaN for an empty cell
  };
  std::string title, scene;
  HistoryColumn x{"t", "t, s"};
  std::vector<HistoryColumn> columns;
  std::vector<Curve> curves;
};

/// Reads the histories of all runs. Throws UsageError for unknown columns, with the nearest names, and for unreadable
/// or empty histories.
HistoryPlot make_history_plot(const StoredResults& results, const std::vector<HistoryColumn>& columns,
                              const HistoryColumn& x = {"t", "t, s"});

std::string history_data(const HistoryPlot& plot);
/// Gnuplot script: a panel per column, a line per run.
std::string history_script(const HistoryPlot& plot, const PlotFiles& files);

}  // namespace taut::cli
