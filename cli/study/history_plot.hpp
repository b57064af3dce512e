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

/// Columns of the history.csv of runs over time, or over another column.
struct HistoryPlot {
  struct Curve {
    std::string name;  // the method, and what else tells the run from others
    std::string method;
    std::vector<std::vector<double>> rows;  // x and the columns; NaN where a cell is empty
  };
  std::string title, scene;
  HistoryColumn x{"t", "t, s"};
  std::vector<HistoryColumn> columns;
  std::vector<Curve> curves;
};

/// Of all runs of `results`. Throws UsageError for a column that a history has not (with the nearest names),
/// and for a history that cannot be read or has no rows.
HistoryPlot make_history_plot(const StoredResults& results, const std::vector<HistoryColumn>& columns,
                              const HistoryColumn& x = {"t", "t, s"});

/// A block for each run.
std::string history_data(const HistoryPlot& plot);
/// The gnuplot script: a panel for each column below the other, a line for each run.
std::string history_script(const HistoryPlot& plot, const PlotFiles& files);

}  // namespace taut::cli
