#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/scene/toml_cursor.hpp"
#include "cli/scene/toml_tree.hpp"
#include "cli/study/chart.hpp"
#include "cli/study/gnuplot.hpp"
#include "cli/study/history_plot.hpp"
#include "cli/study/stability_map.hpp"
#include "cli/system/streams.hpp"

namespace taut::cli {

/// What a study, which is a sweep file with such sections, draws from its results:
///
///     [chart]                                          chart-least_diameter.png, chart-rebound_ratio.png
///     measure = ["least_diameter", "rebound_ratio"]    one or more; without: chart.png, the default
///     cost = "seconds"                                 or "steps"; default: seconds
///     methods = ["enog", "tl"]                         default: all
///     against = "oenog"                                its finest run stands for a reference
///     [map]                                            map.png
///     parameter = "v0"                                 default: the one that is swept beside the method
///     [history]                                        history.png: over time, of all runs,
///     tip = "tip, m"                                   columns of history.csv with the labels of their axes
struct StudyPictures {
  struct Named {
    std::string name;
    FilePlace place;
  };
  struct Charted {
    ChartRequest request;
    FilePlace place;
  };
  struct Mapped {
    MapRequest request;
    FilePlace place;
  };
  std::vector<Charted> charts;
  std::vector<Named> methods;  // that the charts name
  std::optional<Mapped> map;
  std::vector<HistoryColumn> history;  // empty: no such picture
};

/// The sections of a study as they stand. Throws SceneError.
StudyPictures read_pictures(TomlCursor& root);

/// What the runs of a study will have.
struct Shown {
  std::set<std::string> measures;
  std::set<std::string> referenced;   // measures that a reference has something for, of some run
  std::set<std::string> differences;  // measures that are one from a reference
  std::set<std::string> methods;
  std::set<std::string> columns;   // of history.csv
  std::vector<std::string> swept;  // names of the grid, and those of them with several values
  std::vector<std::string> varied;
};

/// Throws SceneError, before anything runs, for what the pictures ask for and the runs will not have.
void check_pictures(const StudyPictures& pictures, const std::filesystem::path& file, const Shown& shown);

/// Draws them from results.csv in `folder`, into `folder`. Gives the exit code. Throws UsageError,
/// OutputError.
int draw_pictures(const StudyPictures& pictures, const std::filesystem::path& folder, Streams streams);

/// A chart of results.csv files; warns of what it leaves out. Throws UsageError.
Chart read_chart(const std::vector<std::string>& results, const ChartRequest& request, std::ostream& err);
/// Draws a chart from results.csv files, and prints the orders of convergence and where the picture is. Gives
/// the exit code. Throws UsageError and OutputError.
int draw_chart(const std::vector<std::string>& results, const ChartRequest& request, const PlotFiles& files,
               Streams streams);
/// The same with histories of all runs.
int draw_history(const StoredResults& results, const std::vector<HistoryColumn>& columns,
                 const HistoryColumn& x, const PlotFiles& files, Streams streams);
/// The same with a map, and its table.
int draw_map(const std::vector<std::string>& results, const MapRequest& request, const PlotFiles& files,
             Streams streams);

}  // namespace taut::cli
