#pragma once

#include <string>
#include <vector>

#include "cli/scene/toml_tree.hpp"
#include "cli/study/gnuplot.hpp"
#include "cli/study/panel_plot.hpp"
#include "cli/study/reference_curves.hpp"
#include "cli/study/stored_results.hpp"

namespace taut::cli {

struct HistoryColumn {
  std::string name, label;  // with a `unit`, the axis label is "LABEL, mm"; else it is the label
  FilePlace place = {};     // in a study
  std::string unit = {};    // SI
};

/// Columns of history.csv of several runs, over time or over another column.
struct HistoryPlot {
  struct Curve {
    std::string name;
    std::string method;
    std::vector<std::vector<double>> rows;  // x, then the columns; NaN for an empty cell
  };
  std::string title, scene;
  HistoryColumn x{"t", "t", {}, "s"};
  std::vector<HistoryColumn> columns;
  std::vector<Curve> curves;
  std::vector<std::vector<std::size_t>> panels{};  // columns of each panel; empty: one column each
  std::vector<ReferenceCurve> references{};        // only if x is the time
};

/// Reads the histories of all runs. Throws UsageError for unknown columns, with the nearest names, and for unreadable
/// or empty histories.
HistoryPlot make_history_plot(const StoredResults& results, const std::vector<HistoryColumn>& columns,
                              const HistoryColumn& x = {"t", "t", {}, "s"});

/// Curves, then references; SI units.
std::string history_data(const HistoryPlot& plot);
/// Gnuplot script: a line per run in each panel, and references in black.
std::string history_script(const HistoryPlot& plot, const PlotFiles& files, const PlotLook& look = {});

}  // namespace taut::cli
