#include <algorithm>
#include <filesystem>
#include <set>

#include <CLI/CLI.hpp>

#include "cli/command_line/command.hpp"
#include "cli/run/folder.hpp"
#include "cli/run/history.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/study/study.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

struct PlotArguments {
  std::vector<std::string> runs, columns;
  std::string x = "t", out;
};

/// The scene that a run was of; a run.json stands for its folder.
Scene scene_of(const StoredRun& run) {
  const RunFolder folder(fs::path(run.file).parent_path());
  std::error_code error;
  if (!fs::exists(folder.scene(), error))
    throw UsageError("'" + run.folder() + "' holds no scene.toml, which says what its columns are");
  return read_scene(folder.scene()).scene;
}

std::vector<std::string> default_columns(const Scene& scene) {
  std::vector<std::string> names;
  for (const Probe& probe : scene.probes) names.push_back(probe.name);
  return names.empty() ? std::vector<std::string>{"total_energy"} : names;
}

HistoryColumn with_label(const std::string& name, const Scene& scene) {
  const std::string unit = history_unit(name, scene);
  return {name, unit.empty() ? name : name + ", " + unit};
}

int plot(const PlotArguments& options, Streams streams) {
  const PlotFiles files = plot_files(options.out);
  StoredResults results;
  Scene first;
  std::set<std::string> named;
  for (const std::string& path : options.runs) {
    results.runs.push_back(read_stored_run(path));
    const Scene scene = scene_of(results.runs.back());
    if (results.runs.size() == 1) first = scene;
    if (named.insert(scene.name).second) {
      results.scene += (results.scene.empty() ? "" : "; ") + scene.name;
      results.title += (results.title.empty() ? "" : "; ") + scene.title;
    }
  }
  std::vector<HistoryColumn> columns;
  for (const std::string& name : options.columns.empty() ? default_columns(first) : options.columns)
    columns.push_back(with_label(name, first));
  return draw_history(results, columns, with_label(options.x, first), files, streams);
}

}  // namespace

std::function<int(Streams)> declare_plot(CLI::App& app) {
  auto options = std::make_shared<PlotArguments>();
  app.add_option("DIR", options->runs, "folders of runs, one or more, over each other")
      ->option_text(" ")
      ->required();
  app.add_option("--columns", options->columns, "of history.csv, a panel each; default: the probes")
      ->option_text("COLUMN,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--x", options->x, "what they are drawn over; default: t")->option_text("COLUMN");
  app.add_option("--out", options->out, "the picture; its .gp and .dat stand beside it")
      ->option_text("plot.png|plot.svg")
      ->required();
  return [options](Streams streams) { return plot(*options, streams); };
}

}  // namespace taut::cli
