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
#include "cli/study/response_plot.hpp"
#include "cli/study/stability_map.hpp"
#include "cli/system/streams.hpp"

namespace taut::cli {

/// Sections [chart], [map] and [history] of a sweep file.
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
  std::vector<Named> methods;
  std::optional<Mapped> map;
  std::vector<HistoryColumn> history;
};

/// Throws SceneError.
StudyPictures read_pictures(TomlCursor& root);

/// Names known before the runs start.
struct AvailableData {
  std::set<std::string> measures;
  std::set<std::string> referenced;   // measures with a reference
  std::set<std::string> differences;  // measures that are differences from a reference
  std::set<std::string> methods;
  std::set<std::string> columns;  // of history.csv
  std::vector<std::string> swept;
  std::vector<std::string> varied;  // with several values
};

/// Throws SceneError for pictures whose data the runs will lack.
void check_pictures(const StudyPictures& pictures, const std::filesystem::path& file,
                    const AvailableData& available);

/// Leaves out charts without errors, with a message. Returns the exit code. Throws UsageError and OutputError.
int draw_pictures(const StudyPictures& pictures, const std::filesystem::path& folder, Streams streams);

/// Prints warnings. Throws like make_chart().
Chart read_chart(const std::vector<std::string>& results, const ChartRequest& request, std::ostream& err);
/// Return the exit code. Throw UsageError and OutputError.
int draw_chart(const std::vector<std::string>& results, const ChartRequest& request, const PlotFiles& files,
               Streams streams);
int draw_history(const HistoryPlot& plot, const PlotFiles& files, Streams streams, const PlotLook& look = {});
int draw_response(const ResponsePlot& plot, const PlotFiles& files, Streams streams,
                  const PlotLook& look = {});
int draw_map(const std::vector<std::string>& results, const MapRequest& request, const PlotFiles& files,
             Streams streams);

}  // namespace taut::cli
