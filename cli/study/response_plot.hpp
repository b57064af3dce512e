#pragma once

#include <string>
#include <vector>

#include "cli/study/panel_plot.hpp"
#include "cli/study/stored_results.hpp"

namespace taut::cli {

struct ResponseRequest {
  std::string x;                  // empty: the only swept parameter
  std::vector<std::string> y{};   // one panel each; '+' joins names in a panel
  std::vector<std::string> by{};  // empty: columns that differ
};

/// Columns of results.csv over another column.
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
  int without_value = 0;  // runs that lack a number
};

/// Throws UsageError for unknown names, columns without numbers, different units in a panel, and equal x in a line.
ResponsePlot make_response_plot(const StoredResults& results, const ResponseRequest& request);

std::string response_data(const ResponsePlot& plot);
std::string response_script(const ResponsePlot& plot, const PlotFiles& files, const PlotLook& look);

}  // namespace taut::cli
