#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "cli/scene/scene_file.hpp"
#include "cli/study/history_plot.hpp"
#include "engine/scene/scene.hpp"

namespace taut::cli {

struct LineRequest {
  std::vector<HistoryColumn> lines;
  std::vector<double> times;  // s; empty: all
  HistoryColumn x;            // "s", the distance from the first point, or a coordinate: "x"
};

/// Throws UsageError for an unknown line.
std::string line_unit(const std::string& line, const Scene& scene);
/// "s" and the coordinates.
std::vector<std::string> line_axes(int dim);

/// Plots lines.csv: a curve per run and time, a column per line. `scenes[k]` is of `results.runs[k]`. Prints missing
/// samples on `err`. Throws UsageError, also without any sample.
HistoryPlot make_line_plot(const StoredResults& results, const std::vector<SceneFile>& scenes,
                           const LineRequest& request, std::ostream& err);

}  // namespace taut::cli
