#pragma once

#include <string>
#include <vector>

#include "cli/study/panel_plot.hpp"
#include "cli/study/stored_results.hpp"

namespace taut::cli {

struct ResponseRequest {
  std::string x;                  // empty: the only swept parameter beside the method
  std::vector<std::string> y{};   // a panel each; names joined by '+' share a panel
  std::vector<std::string> by{};  // a line per combination of values; empty: whatever differs
};

/// Answers of runs (measures or other columns of results.csv) over a setting of the runs.
struct ResponsePlot {
  struct Point {
    double x = 0, y = 0;
    bool stable = true;
  };
  struct Line {
    std::string name, method, column;
    bool is_reference = false;
    std::vector<Point> points;  // x ascends
  };
  struct Panel {
    std::vector<ResultColumn> columns;
    std::vector<Line> lines;  // references last
  };
  std::string title, scene;
  ResultColumn x;
  std::vector<Panel> panels;
  int without_value = 0;  // runs missing in some panel
};

/// Throws UsageError for unknown names, for columns without numbers, for columns of one panel with different units, and
/// if two runs of a line have equal x.
ResponsePlot make_response_plot(const StoredResults& results, const ResponseRequest& request);

std::string response_data(const ResponsePlot& plot);
/// Gnuplot script. Runs that are not stable have open markers.
std::string response_script(const ResponsePlot& plot, const PlotFiles& files, const PlotLook& look);

}  // namespace taut::cli
