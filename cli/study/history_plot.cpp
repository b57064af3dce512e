#include "cli/study/history_plot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include <fmt/core.h>

#include "cli/study/csv.hpp"
#include "cli/study/curve_style.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

std::size_t column_of(const CsvTable& table, const std::string& name) {
  const auto found = std::ranges::find(table.columns, name);
  if (found == table.columns.end()) throw UsageError(unknown_name("history column", name, table.columns));
  return static_cast<std::size_t>(found - table.columns.begin());
}

std::vector<std::vector<double>> rows_of(const CsvTable& table, const std::vector<HistoryColumn>& columns) {
  std::vector<std::size_t> places;
  for (const HistoryColumn& column : columns) places.push_back(column_of(table, column.name));
  constexpr double greatest = 1e290;  // gnuplot needs room beyond an axis
  std::vector<std::vector<double>> rows;
  for (const auto& cells : table.rows) {
    rows.emplace_back();
    for (const std::size_t place : places) {
      const double value = parsed<double>(cells[place]).value_or(NAN);
      rows.back().push_back(std::abs(value) < greatest ? value : NAN);
    }
  }
  const auto drawn = [](const std::vector<double>& row, std::size_t k) {
    return std::isfinite(row[0]) && std::isfinite(row[k]);
  };
  for (std::size_t k = 1; k < columns.size(); ++k)
    if (std::ranges::none_of(rows, [&](const auto& row) { return drawn(row, k); }))
      throw UsageError(
          fmt::format("no row has numbers in both columns '{}' and '{}'", columns[0].name, columns[k].name));
  return rows;
}

/// Groups runs that differ only in the last number of their names, such as those of a method, and sorts each group.
void put_in_order(std::vector<NamedRun>& runs) {
  const auto number = [](const NamedRun& run) {
    return parsed<double>(run.name.substr(run.name.rfind('=') + 1));
  };
  const auto beginning = [](const NamedRun& run) { return run.name.substr(0, run.name.rfind('=')); };
  if (!std::ranges::all_of(runs, [&](const NamedRun& run) { return number(run).has_value(); })) return;
  std::map<std::string, std::size_t> groups;
  for (const NamedRun& run : runs) groups.try_emplace(beginning(run), groups.size());
  std::ranges::stable_sort(
      runs, {}, [&](const NamedRun& run) { return std::pair(groups[beginning(run)], *number(run)); });
}

}  // namespace

std::vector<NamedRun> named_runs(const std::vector<StoredRun>& runs) {
  const std::vector<std::string> distinguishing = distinguishing_columns(runs, "");
  std::vector<NamedRun> named;
  std::map<std::string, int> uses;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    named.push_back({series_name(runs[k], distinguishing), k});
    ++uses[named.back().name];
  }
  for (NamedRun& run : named)
    if (uses[run.name] > 1)
      run.name +=
          ", " + std::filesystem::absolute(runs[run.index].folder() + "/").parent_path().filename().string();
  put_in_order(named);
  return named;
}

HistoryPlot make_history_plot(const StoredResults& results, const std::vector<HistoryColumn>& columns,
                              const HistoryColumn& x) {
  HistoryPlot plot{.title = results.title,
                   .scene = results.scene,
                   .x = x,
                   .columns = columns,
                   .curves = {},
                   .panels = {},
                   .references = {}};
  std::vector<HistoryColumn> all{x};
  all.insert(all.end(), columns.begin(), columns.end());
  for (const auto& [name, index] : named_runs(results.runs)) {
    const StoredRun& run = results.runs[index];
    const auto file = std::filesystem::path(run.folder()) / "history.csv";
    const CsvTable history = read_csv(file);
    if (history.rows.empty()) throw UsageError(fmt::format("'{}' has no rows yet", file.string()));
    try {
      plot.curves.push_back({name, run.method(), rows_of(history, all)});
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}: {}", file.string(), error.what()));
    }
  }
  return plot;
}

namespace {

std::string heading(const HistoryColumn& column) {
  return column.unit.empty() ? column.label : fmt::format("{}, {}", column.label, column.unit);
}

std::string numbers(const std::vector<double>& row) {
  std::vector<std::string> texts;
  for (const double value : row) texts.push_back(std::isfinite(value) ? exact(value) : "NaN");
  return join(texts, " ") + "\n";
}

}  // namespace

std::string history_data(const HistoryPlot& plot) {
  std::string text;
  for (const HistoryPlot::Curve& curve : plot.curves) {
    std::string headings = heading(plot.x);
    for (const HistoryColumn& column : plot.columns) headings += "; " + heading(column);
    text += plot_comment(curve.name) + plot_comment(headings);
    for (const auto& row : curve.rows) text += numbers(row);
    text += "\n\n";
  }
  for (const ReferenceCurve& curve : plot.references) {
    text += plot_comment(fmt::format("reference of {}: {}{}", curve.column, curve.name, curve.time));
    for (std::size_t k = 0; k < curve.t.size(); ++k) text += numbers({curve.t[k], curve.values[k]});
    text += "\n\n";
  }
  return text;
}

namespace {

constexpr std::size_t most_named = 100;

struct ValueRange {
  bool is_log = false;
  double low = INFINITY, high = -INFINITY;
  void add(double value) {
    if (std::isfinite(value) && (!is_log || value > 0))
      low = std::min(low, value), high = std::max(high, value);
  }
  double greatest() const { return std::max(std::abs(low), std::abs(high)); }
};

bool is_of_one_method(const HistoryPlot& plot) {
  return plot.curves.size() > 1 && std::ranges::all_of(plot.curves, [&](const HistoryPlot::Curve& curve) {
           return curve.name.starts_with(plot.curves.front().method + ", ");
         });
}

ValueRange values_of(const HistoryPlot& plot, std::size_t place, bool is_log) {
  ValueRange all{.is_log = is_log};
  for (const HistoryPlot::Curve& curve : plot.curves)
    for (const auto& row : curve.rows)
      if (std::isfinite(row[0])) all.add(row[place]);
  return all;
}

struct HistoryLegend {
  std::vector<std::string> names;
  std::vector<CurveStyle> styles;
  std::vector<PanelPlot::Entry> entries{};

  /// Columns of one panel differ in dashes, or, for a single run, in colours.
  std::string line(const HistoryPlot& plot, std::size_t run, const std::vector<std::size_t>& panel,
                   std::size_t place) {
    CurveStyle style = styles[run];
    std::string name = names[run];
    if (panel.size() > 1) {
      const std::string& column = plot.columns[panel[place]].label;
      const bool single = plot.curves.size() == 1;
      name = single ? column : fmt::format("{}, {}", name, column);
      style = single ? numbered_style(place) : style;
      if (!single) style.dash = static_cast<int>(place) + 1;
    }
    return add(name, "with lines linewidth 1.5 " + style.line());
  }
  std::string add(const std::string& name, const std::string& style) {
    const PanelPlot::Entry entry{name, style};
    if (std::ranges::find(entries, entry) == entries.end()) entries.push_back(entry);
    return style;
  }
};

PanelPlot::Panel panel_of(const HistoryPlot& plot, const std::vector<std::size_t>& columns, double of_x,
                          const PlotLook& look, HistoryLegend& legend) {
  ValueRange all{.is_log = look.log_y};
  std::vector<std::string> labels;
  for (const std::size_t column : columns) {
    const ValueRange values = values_of(plot, column + 1, look.log_y);
    all.add(values.low), all.add(values.high);
    labels.push_back(plot.columns[column].label);
  }
  const auto belongs = [&](const ReferenceCurve& curve) {
    return std::ranges::any_of(columns, [&](std::size_t c) { return plot.columns[c].name == curve.column; });
  };
  for (const ReferenceCurve& curve : plot.references)
    if (belongs(curve))
      for (const double value : curve.values) all.add(value);
  const std::string& unit = plot.columns[columns.front()].unit;
  // the legend names several columns
  const std::string label = columns.size() > 1 && !unit.empty() ? "" : join(labels);
  const AxisScale y =
      unit.empty() ? AxisScale{1, label} : axis_scale(label, unit, all.greatest(), look.log_y);
  if (look.log_y && all.low > all.high)
    throw UsageError(fmt::format("no value of {} is positive; leave out --log y", join(labels)));
  PanelPlot::Panel panel{
      .label = y.label, .low = y.factor * all.low, .high = y.factor * all.high, .lines = {}};
  const auto points = [&](std::size_t block, std::size_t column) {
    return fmt::format("data index {} using ($1*{}):(${}*{})", block, exact(of_x), column, exact(y.factor));
  };
  for (std::size_t run = 0; run < plot.curves.size(); ++run)
    for (std::size_t place = 0; place < columns.size(); ++place)
      panel.lines.push_back(fmt::format("{} {} notitle", points(run, columns[place] + 2),
                                        legend.line(plot, run, columns, place)));
  for (std::size_t k = 0; k < plot.references.size(); ++k)
    if (belongs(plot.references[k]))
      panel.lines.push_back(
          fmt::format("{} {} notitle", points(plot.curves.size() + k, 2),
                      legend.add("reference: " + shortened(plot.references[k].name), reference_line)));
  return panel;
}

}  // namespace

std::string hidden_by_log(const HistoryPlot& plot, const PlotLook& look) {
  std::vector<std::string> names;
  const auto add_column = [&](const std::string& name, std::size_t place, const auto& is_hidden) {
    const auto hides = [&](const HistoryPlot::Curve& curve) {
      return std::ranges::any_of(curve.rows, [&](const auto& row) { return is_hidden(row[place]); });
    };
    if (std::ranges::any_of(plot.curves, hides)) names.push_back(name);
  };
  // every history begins at t = 0
  if (look.log_x) add_column(plot.x.name, 0, [](double value) { return value < 0; });
  for (std::size_t k = 0; look.log_y && k < plot.columns.size(); ++k)
    add_column(plot.columns[k].name, k + 1, [](double value) { return value <= 0; });
  return names.empty() ? "" : "values ≤ 0 are not drawn on logarithmic axes: " + join(names);
}

std::string history_script(const HistoryPlot& plot, const PlotFiles& files, const PlotLook& look) {
  const bool of_one = is_of_one_method(plot);
  HistoryLegend legend;
  std::vector<std::string> methods;
  for (const HistoryPlot::Curve& curve : plot.curves) {
    legend.names.push_back(shortened(of_one ? curve.name.substr(curve.method.size() + 2) : curve.name));
    methods.push_back(curve.method);
  }
  const bool has_columns =
      std::ranges::any_of(plot.panels, [](const auto& panel) { return panel.size() > 1; });
  legend.styles = line_styles(methods, has_columns);
  const ValueRange of_x = values_of(plot, 0, look.log_x);
  if (look.log_x && of_x.low > of_x.high)
    throw UsageError(fmt::format("no value of {} is positive; leave out --log x", plot.x.name));
  const AxisScale x = plot.x.unit.empty()
                          ? AxisScale{1, plot.x.label}
                          : axis_scale(plot.x.label, plot.x.unit, of_x.greatest(), look.log_x);
  std::vector<std::vector<std::size_t>> panels = plot.panels;
  for (std::size_t k = 0; panels.size() < plot.columns.size() && plot.panels.empty(); ++k)
    panels.push_back({k});
  PanelPlot drawn{.title = of_one ? fmt::format("{}, {}", plot.title, methods.front()) : plot.title,
                  .x_label = x.label,
                  .x_low = x.factor * of_x.low,
                  .x_high = x.factor * of_x.high,
                  .panels = {},
                  .legend = {}};
  for (const auto& columns : panels) drawn.panels.push_back(panel_of(plot, columns, x.factor, look, legend));
  if (legend.entries.size() <= most_named)
    drawn.legend = legend.entries;
  else
    drawn.note =
        fmt::format("{} runs; their names are in {}", plot.curves.size(), files.data().filename().string());
  return panel_script(drawn, files, look);
}

}  // namespace taut::cli
