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

struct HistoryPlot {
  struct Curve {
    std::string name;
    std::string method;
    std::vector<std::vector<double>> rows;  // x, columns; NaN: empty
  };
  std::string title, scene;
  HistoryColumn x{"t", "t, s"};
  std::vector<HistoryColumn> columns;
  std::vector<Curve> curves;
};

/// Throws UsageError for unknown columns, and for unreadable or empty histories.
HistoryPlot make_history_plot(const StoredResults& results, const std::vector<HistoryColumn>& columns,
                              const HistoryColumn& x = {"t", "t, s"});

std::string history_data(const HistoryPlot& plot);
/// A panel per column, a line per run.
std::string history_script(const HistoryPlot& plot, const PlotFiles& files);

}  // namespace taut::cli
