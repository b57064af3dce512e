#include <algorithm>
#include <filesystem>
#include <ostream>
#include <set>
#include <sstream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/drawing/page_keys.hpp"
#include "cli/run/folder.hpp"
#include "cli/run/history.hpp"
#include "cli/run/schedule.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/study/line_plot.hpp"
#include "cli/study/study.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

struct PlotArguments : PlotLookOptions {
  std::vector<std::string> paths, columns, lines, y, by;
  std::vector<double> times;  // s
  std::optional<std::string> x;
  std::string out;
};

SceneFile scene_of(const StoredRun& run) {
  const RunFolder folder(fs::path(run.file).filename() == "run.json" ? fs::path(run.file).parent_path()
                                                                     : fs::path(run.folder()));
  std::error_code error;
  if (!fs::is_regular_file(folder.scene(), error))
    throw UsageError(fmt::format(
        "'{}' contains no scene.toml, which is needed for the units; name a run folder", run.folder()));
  return read_scene(folder.scene());
}

/// run.json lacks the constants of the method.
void add_constants(StoredRun& run, const SceneFile& scene) {
  for (const ResolvedSetting& each : scene.resolved)
    if (const std::string column = std::string(set_prefix) + each.name;
        each.name.starts_with(constant_prefix) && each.value != each.default_value &&
        run.text(column).empty())
      run.cells.emplace_back(column, each.value);
}

struct PlotPaths {
  std::vector<std::string> runs, sweeps, tables_of_runs, others;
};

bool contains_file(const std::string& folder, const char* name) {
  std::error_code error;
  return fs::symlink_status(fs::path(folder) / name, error).type() > fs::file_type::not_found;
}

/// DIR/* names a sweep's table and its runs; the table is then ignored.
PlotPaths sorted_paths(const std::vector<std::string>& given) {
  PlotPaths paths;
  const auto is_beside = [](const fs::path& table) {
    return [table](const std::string& run) {
      return fs::path(run).lexically_normal().parent_path() == table.parent_path();
    };
  };
  std::vector<std::string> tables;
  for (const std::string& path : given) {
    std::error_code error;
    const fs::path named = fs::path(path).filename();
    if (fs::is_directory(path, error) && contains_file(path, "results.csv"))
      paths.sweeps.push_back(path);
    else if (given.size() == 1 && named != "results.csv")
      paths.runs.push_back(path);
    else if (named == "results.csv")
      tables.push_back(path);
    else if (named == "run.json" || contains_file(path, "run.json") || !fs::exists(path, error))
      paths.runs.push_back(path);  // the reader reports missing paths
    else
      paths.others.push_back(path);
  }
  for (const std::string& table : tables)
    (std::ranges::any_of(paths.runs, is_beside(fs::path(table).lexically_normal())) ? paths.tables_of_runs
                                                                                    : paths.sweeps)
        .push_back(table);
  if (paths.runs.empty() && paths.sweeps.empty())
    throw UsageError(
        join(paths.others) +
        ": none of these is a run or a sweep; name folders that `taut run` or `taut sweep` has made");
  return paths;
}

void report_skipped(const std::vector<std::string>& paths, const char* why, std::ostream& err) {
  if (paths.empty()) return;
  std::vector<std::string> names;
  for (const std::string& path : paths) names.push_back(fs::path(path).filename().string());
  constexpr std::size_t most = 5;
  const std::size_t more = names.size() > most ? names.size() - most : 0;
  names.resize(names.size() - more);
  err << "taut: skipped (" << why << "): " << join(names)
      << (more > 0 ? fmt::format(" and {} more", more) : "") << '\n';
}

StoredResults read_all(const PlotPaths& paths, std::ostream& err) {
  report_skipped(paths.others, "neither a run nor a sweep", err);
  report_skipped(paths.tables_of_runs, "runs of the same folder are drawn instead", err);
  StoredResults results;
  if (!paths.sweeps.empty()) results = read_results(paths.sweeps);
  for (const std::string& path : paths.runs) results.runs.push_back(read_stored_run(path));
  return results;
}

std::vector<std::string> default_columns(const Scene& scene) {
  std::vector<std::string> names;
  for (const Probe& probe : scene.probes) names.push_back(probe.name);
  return names.empty() ? std::vector<std::string>{"total_energy"} : names;
}

using UnitOf = std::string (*)(const std::string& name, const Scene& scene);

/// Missing columns are reported later.
void refuse_two_units(const std::string& column, UnitOf unit_of, const StoredRun& run, const Scene& scene,
                      const StoredRun& first, const Scene& of_first) {
  const std::string unit = unit_of(column, scene), before = unit_of(column, of_first);
  const std::vector<std::string> there = history_columns(scene);
  const bool is_missing = unit_of == history_unit && std::ranges::find(there, column) == there.end();
  if (unit == before || is_missing) return;
  const auto named = [](const std::string& of) { return of.empty() ? "without a unit" : "in " + of; };
  throw UsageError(fmt::format("{} '{}' is {} in '{}' and {} in '{}'; plot these runs separately",
                               unit_of == history_unit ? "column" : "line", column, named(before),
                               first.folder(), named(unit), run.folder()));
}

void add_titles(StoredResults& results, const std::vector<SceneFile>& scenes) {
  std::set<std::string> named;
  if (!results.title.empty()) return;
  for (const SceneFile& file : scenes)
    if (named.insert(file.scene.name).second) {
      results.scene += (results.scene.empty() ? "" : "; ") + file.scene.name;
      results.title += (results.title.empty() ? "" : "; ") + file.scene.title;
    }
}

/// Panels such as "a+b".
struct JoinedColumns {
  std::vector<std::string> names;
  std::vector<std::vector<std::size_t>> panels;

  JoinedColumns(const char* option, const std::vector<std::string>& typed) {
    for (const std::string& panel : typed) {
      panels.emplace_back();
      std::istringstream words(panel);
      for (std::string name; std::getline(words, name, '+');) {
        panels.back().push_back(names.size());
        names.push_back(name);
      }
      if (panels.back().empty()) throw UsageError(fmt::format("{} has an empty name", option));
    }
  }

  void refuse_two_units(const Scene& scene, UnitOf unit_of) const {
    for (const auto& panel : panels)
      for (const std::size_t column : panel)
        if (const std::string& first = names[panel.front()];
            unit_of(names[column], scene) != unit_of(first, scene))
          throw UsageError(fmt::format(
              "'{0}' and '{1}' have different units ('{2}', '{3}'); draw each in its own panel: {0},{1}",
              first, names[column], unit_of(first, scene), unit_of(names[column], scene)));
  }
};

std::vector<ReferenceCurve> references_of(const HistoryPlot& plot, const StoredResults& results,
                                          const std::vector<SceneFile>& scenes) {
  std::vector<ReferenceCurve> all;
  double until = 0;
  for (const HistoryPlot::Curve& curve : plot.curves) until = std::max(until, curve.rows.back().front());
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const Scene& scene = scenes[k].scene;
    for (ReferenceCurve& curve : reference_curves(scene, results.runs[k].text("material_law"),
                                                  times_in_parts(scene.until, solution_samples))) {
      const auto beyond = std::ranges::upper_bound(curve.t, until * (1 + 1e-9)) - curve.t.begin();
      curve.t.resize(static_cast<std::size_t>(beyond));
      curve.values.resize(curve.t.size());
      const bool drawn =
          std::ranges::find(plot.columns, curve.column, &HistoryColumn::name) != plot.columns.end();
      if (drawn && !curve.t.empty() && std::ranges::find(all, curve) == all.end())
        all.push_back(std::move(curve));
    }
  }
  return all;
}

HistoryColumn axis_of(const PlotArguments& options, const Scene& scene) {
  const std::string x = options.x.value_or("s");
  const std::vector<std::string> axes = line_axes(scene.dim);
  if (std::ranges::find(axes, x) == axes.end()) throw UsageError(unknown_name("axis of lines", x, axes));
  return {x, x == "s" ? "distance from the first point" : x, {}, "m"};
}

int plot_curves(const PlotArguments& options, StoredResults results, const PlotFiles& files,
                const PlotLook& look, Streams streams) {
  std::erase_if(results.runs, [](const StoredRun& run) {
    return fs::path(run.file).filename() == "results.csv" && !run.has_result();
  });
  std::vector<SceneFile> scenes;
  for (StoredRun& run : results.runs) {
    scenes.push_back(scene_of(run));
    add_constants(run, scenes.back());
  }
  add_titles(results, scenes);
  const Scene& first = scenes.front().scene;
  const bool along_lines = !options.lines.empty();
  const UnitOf unit_of = along_lines ? line_unit : history_unit;
  const JoinedColumns joined =
      along_lines
          ? JoinedColumns("--lines", options.lines)
          : JoinedColumns("--columns", options.columns.empty() ? default_columns(first) : options.columns);
  std::vector<std::string> names = joined.names;
  if (!along_lines) names.push_back(options.x.value_or("t"));
  for (std::size_t k = 1; k < scenes.size(); ++k)
    for (const std::string& name : names)
      refuse_two_units(name, unit_of, results.runs[k], scenes[k].scene, results.runs.front(), first);
  const auto with_unit = [&](const std::string& name) {
    return HistoryColumn{name, name, {}, unit_of(name, first)};
  };
  std::vector<HistoryColumn> columns;
  for (const std::string& name : joined.names) columns.push_back(with_unit(name));
  HistoryPlot plot =
      along_lines
          ? make_line_plot(results, scenes, {columns, options.times, axis_of(options, first)}, streams.err)
          : make_history_plot(results, columns, with_unit(names.back()));
  joined.refuse_two_units(first, unit_of);
  plot.panels = joined.panels;
  if (!along_lines && plot.x.name == "t") plot.references = references_of(plot, results, scenes);
  return draw_history(plot, files, streams, look);
}

/// Adds missing units and a missing title from the first scene file.
void add_units(StoredResults& results) {
  std::vector<SceneFile> scenes;
  try {
    for (const StoredRun& run : results.runs)
      if (fs::path(run.file).filename() == "run.json" && scenes.empty()) scenes.push_back(scene_of(run));
  } catch (const UsageError&) {
    return;
  }
  for (const SceneFile& file : scenes)
    for (const Parameter& parameter : file.parameters)
      if (!parameter.unit.empty() && parameter.unit != "1")
        results.units.try_emplace(parameter.name, parameter.unit);
  add_titles(results, scenes);
}

int plot(const PlotArguments& options, Streams streams) {
  const PlotFiles files = plot_files(options.out);
  const PlotLook look = plot_look(options, files);
  if (options.y.empty() && !options.by.empty())
    throw UsageError("--by needs --y, the measures or columns of results.csv to draw over --x");
  if (!options.times.empty() && options.lines.empty())
    throw UsageError("--times needs --lines, the lines of lines.csv to draw");
  if (!options.y.empty() + !options.columns.empty() + !options.lines.empty() > 1)
    throw UsageError(
        "--columns draws histories, --lines draws profiles, --y draws measures over a parameter; "
        "give only one of them");
  StoredResults results = read_all(sorted_paths(options.paths), streams.err);
  if (options.y.empty()) return plot_curves(options, std::move(results), files, look, streams);
  add_units(results);
  return draw_response(make_response_plot(results, {options.x.value_or(""), options.y, options.by}), files,
                       streams, look);
}

}  // namespace

std::function<int(Streams)> declare_plot(Options& command) {
  auto options = std::make_shared<PlotArguments>();
  command
      .add_argument("DIR", options->paths,
                    "run folders, or folders or results.csv of sweeps; other files are skipped")
      .required();
  command
      .add("--columns", "COLUMN,...", options->columns,
           "columns of history.csv, one panel each; "
           "a+b: both in one panel; default: all probes, else total_energy")
      .comma_separated();
  command
      .add("--lines", "LINE,...", options->lines,
           "lines of lines.csv to draw instead of histories, one panel each; a+b: both in one panel")
      .comma_separated();
  command.add("--times", "T,...", options->times, "with --lines: sampled times to draw, s; default: all")
      .comma_separated();
  command
      .add("--y", "MEASURE,...", options->y,
           "measures, such as deflection or deflection.error, or columns of results.csv, one panel each; "
           "a+b: both in one panel")
      .comma_separated();
  command.add("--x", "COLUMN", options->x,
              "x axis: a column of history.csv, default: t; with --y: a parameter or column of results.csv, "
              "default: the only swept parameter; with --lines: x, y, z or s, "
              "the distance from the first point, default: s");
  command
      .add("--by", "PARAMETER,...", options->by,
           "with --y: draw one line for each value, such as method; default: all settings that differ")
      .comma_separated();
  command.add("--log", "x|y|xy", options->log, "axes with logarithmic scale");
  command.add("--title", "TEXT|none", options->title, "title; default: the title of the sweep or scene")
      .check(line_of_text);
  command.add("--size", "WIDTHxHEIGHT", options->size, "size, pixels; with --width: aspect ratio");
  command.add("--width", "LENGTH", options->width,
              "width on paper, such as 85mm; the defaults are then --dpi 300 and --font-size 7");
  command.add("--dpi", "N", options->dpi, "pixels per inch of a PNG; default: 96").check(positive_number);
  command.add("--font-size", "POINTS", options->font_size, "size of texts, points; default: 11")
      .check(positive_number);
  command
      .add("--out", "plot.png|plot.svg|plot.pdf", options->out,
           "picture to write; the gnuplot script (.gp) and its data (.dat) are written beside it")
      .required();
  return [options](Streams streams) { return plot(*options, streams); };
}

}  // namespace taut::cli
