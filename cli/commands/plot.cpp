#include <algorithm>
#include <filesystem>
#include <set>

#include "cli/arguments/options.hpp"
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

Scene scene_of(const StoredRun& run) {
  const RunFolder folder(fs::path(run.file).parent_path());
  std::error_code error;
  if (!fs::exists(folder.scene(), error))
    throw UsageError("'" + run.folder() +
                     "' contains no scene.toml, which is needed for the units; name a run folder");
  return read_scene(folder.scene()).scene;
}

std::vector<std::string> default_columns(const Scene& scene) {
  std::vector<std::string> names;
  for (const Probe& probe : scene.probes) names.push_back(probe.name);
  return names.empty() ? std::vector<std::string>{"total_energy"} : names;
}

void refuse_two_units(const std::string& column, const StoredRun& run, const Scene& scene,
                      const StoredRun& first, const Scene& of_first) {
  const std::string unit = history_unit(column, scene), before = history_unit(column, of_first);
  const std::vector<std::string> there = history_columns(scene);  // missing columns are reported later
  if (unit == before || std::ranges::find(there, column) == there.end()) return;
  const auto named = [](const std::string& of) { return of.empty() ? "without a unit" : "in " + of; };
  throw UsageError("column '" + column + "' is " + named(before) + " in '" + first.folder() + "' and " +
                   named(unit) + " in '" + run.folder() + "'; plot these runs separately");
}

HistoryColumn with_label(const std::string& name, const Scene& scene) {
  const std::string unit = history_unit(name, scene);
  return {name, unit.empty() ? name : name + ", " + unit};
}

int plot(const PlotArguments& options, Streams streams) {
  const PlotFiles files = plot_files(options.out);
  StoredResults results;
  std::vector<Scene> scenes;
  std::set<std::string> named;
  for (const std::string& path : options.runs) {
    results.runs.push_back(read_stored_run(path));
    const Scene& scene = scenes.emplace_back(scene_of(results.runs.back()));
    if (named.insert(scene.name).second) {
      results.scene += (results.scene.empty() ? "" : "; ") + scene.name;
      results.title += (results.title.empty() ? "" : "; ") + scene.title;
    }
  }
  const Scene& first = scenes.front();
  std::vector<std::string> names = options.columns.empty() ? default_columns(first) : options.columns;
  std::vector<HistoryColumn> columns;
  for (const std::string& name : names) columns.push_back(with_label(name, first));
  names.push_back(options.x);
  for (std::size_t k = 1; k < scenes.size(); ++k)
    for (const std::string& name : names)
      refuse_two_units(name, results.runs[k], scenes[k], results.runs.front(), first);
  return draw_history(results, columns, with_label(options.x, first), files, streams);
}

}  // namespace

std::function<int(Streams)> declare_plot(Options& command) {
  auto options = std::make_shared<PlotArguments>();
  command.add_argument("DIR", options->runs, "one or more run folders; each panel shows all runs").required();
  command
      .add("--columns", "COLUMN,...", options->columns,
           "columns of history.csv, one panel each; default: all probes, else total_energy")
      .comma_separated();
  command.add("--x", "COLUMN", options->x, "column of the x axis; default: t");
  command
      .add("--out", "plot.png|plot.svg", options->out,
           "picture to write; the gnuplot script (.gp) and its data (.dat) are written beside it")
      .required();
  return [options](Streams streams) { return plot(*options, streams); };
}

}  // namespace taut::cli
