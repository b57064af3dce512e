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
  std::string name, label;  // `label` lacks the unit
  FilePlace place = {};     // in the study file
  std::string unit = {};    // SI
};

struct HistoryPlot {
  struct Curve {
    std::string name;
    std::string method;
    std::vector<std::vector<double>> rows;  // x, then columns; NaN: not drawn
  };
  std::string title, scene;
  HistoryColumn x{"t", "t", {}, "s"};
  std::vector<HistoryColumn> columns;
  std::vector<Curve> curves;
  std::vector<std::vector<std::size_t>> panels{};  // empty: one per column
  std::vector<ReferenceCurve> references{};
  const char* kind = "history";  // in messages
};

struct NamedRun {
  std::string name;
  std::size_t index;  // in the results
};
/// Distinct names, in the order of the legend.
std::vector<NamedRun> named_runs(const std::vector<StoredRun>& runs);

/// Throws UsageError for unknown columns, and for unreadable or empty histories.
HistoryPlot make_history_plot(const StoredResults& results, const std::vector<HistoryColumn>& columns,
                              const HistoryColumn& x = {"t", "t", {}, "s"});

/// Curves, then references; SI units.
std::string history_data(const HistoryPlot& plot);
/// Note about values ≤ 0 that logarithmic axes omit; empty if there are none.
std::string hidden_by_log(const HistoryPlot& plot, const PlotLook& look);
std::string history_script(const HistoryPlot& plot, const PlotFiles& files, const PlotLook& look = {});

}  // namespace taut::cli
