#include "cli/study/response_plot.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/core.h>

#include "cli/study/curve_style.hpp"
#include "cli/study/stability_map.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

using Line = ResponsePlot::Line;
using Point = ResponsePlot::Point;

std::vector<std::string> split_at_plus(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream words(text);
  for (std::string part; std::getline(words, part, '+');) parts.push_back(part);
  return parts;
}

/// Adds a prefix, such as "set.".
std::string column_with(const StoredRun& run, const std::string& name) {
  for (const std::string prefix : {set_prefix.data(), "parameters."})
    if (!run.text(prefix + name).empty()) return prefix + name;
  return name;
}

struct LineNames {
  std::vector<ResultColumn> by;
  std::vector<std::string> distinguishing;  // if `by` is empty: columns that differ

  std::string operator()(const StoredRun& run) const {
    if (by.empty()) return series_name(run, distinguishing);
    std::vector<std::string> parts;
    for (const ResultColumn& column : by) {
      const std::string value = column.text(run);
      if (!value.empty()) parts.push_back(column.name == "method" ? value : column.name + "=" + value);
    }
    return parts.empty() ? "(none)" : join(parts);
  }
};

/// Throws UsageError for two runs with the same x on one line.
[[noreturn]] void refuse_two(const StoredRun& a, const StoredRun& b, const std::string& line,
                             const ResultColumn& x, const ResponseRequest& request) {
  std::vector<std::string> differing;
  for (const std::string& column : distinguishing_columns({a, b}, column_with(a, x.name))) {
    const std::size_t dot = column.starts_with(set_prefix) ? set_prefix.size() : 0;
    differing.push_back(column.substr(dot));
  }
  if (a.method() != b.method()) differing.insert(differing.begin(), "method");
  const std::string runs = fmt::format("'{}' and '{}'", a.folder(), b.folder());
  if (differing.empty())
    throw UsageError(fmt::format("the runs {} have the same settings; leave out one of them", runs));
  std::vector<std::string> by = request.by;
  by.push_back(differing.front());
  throw UsageError(fmt::format(
      "line '{}' would have two values at {} = {}: the runs {} differ in {}; draw a line for each with --by {}",
      line, x.name, x.text(a), runs, join(differing), join(by, ",")));
}

/// Throws UsageError unless one parameter is swept.
std::string only_parameter(const StoredResults& results) {
  const auto is_swept = [](const StoredRun& run) {
    return std::ranges::any_of(run.cells,
                               [](const auto& cell) { return cell.first.starts_with(set_prefix); });
  };
  if (std::ranges::any_of(results.runs, is_swept)) return swept_parameter(results.runs, "", "--x");
  std::vector<std::string> names = distinguishing_columns(results.runs, "");
  for (std::string& name : names) name = name.substr(name.find('.') + 1);
  throw UsageError(fmt::format("name the column of the x axis with --x{}",
                               names.empty() ? "" : "; the runs differ in " + join(names)));
}

using Runs = std::vector<const StoredRun*>;

/// A line per reference, or one per line of runs if values of a reference differ at the same x.
std::vector<Line> references_of(const Runs& runs, const ResultColumn& x, const ResultColumn& y,
                                const LineNames& name_of) {
  std::map<std::string, std::map<double, double>> shared, own;
  std::map<std::string, bool> agrees;
  for (const StoredRun* run : runs) {
    const MeasureResult& measure = run->record.measure(y.measure);
    const auto value = measure.reference, at = x.number(*run);
    if (!value || !at) continue;
    const std::string& name = measure.reference_name;
    const auto [found, fresh] = shared[name].try_emplace(*at, *value);
    agrees.try_emplace(name, true);
    if (!fresh && found->second != *value) agrees[name] = false;
    own[fmt::format("{}{}{}", name, name.empty() ? "" : ", ", name_of(*run))][*at] = *value;
  }
  const bool all_agree = std::ranges::all_of(agrees, [](const auto& one) { return one.second; });
  std::vector<Line> lines;
  for (const auto& [name, values] : all_agree ? shared : own) {
    Line line{.name = name.empty() ? "reference" : "reference: " + name,
              .method = "",
              .column = y.name,
              .is_reference = true,
              .points = {}};
    for (const auto& [at, value] : values) line.points.push_back({at, value, true});
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<Line> lines_of(const Runs& runs, const ResponsePlot& plot, const ResultColumn& y,
                           const LineNames& name_of, const ResponseRequest& request) {
  std::vector<Line> lines;
  std::map<std::pair<std::string, double>, const StoredRun*> seen;
  for (const StoredRun* run : runs) {
    const auto at = plot.x.number(*run), value = y.number(*run);
    if (!at || !value) continue;
    const std::string name = name_of(*run);
    const auto [other, fresh] = seen.try_emplace({name, *at}, run);
    if (!fresh) refuse_two(*other->second, *run, name, plot.x, request);
    auto line = std::ranges::find(lines, name, &Line::name);
    if (line == lines.end())
      line =
          lines.insert(lines.end(), {.name = name, .method = run->method(), .column = y.name, .points = {}});
    line->points.push_back({*at, *value, run->is_stable()});
  }
  for (Line& line : lines) std::ranges::sort(line.points, {}, &Point::x);
  return lines;
}

ResponsePlot::Panel panel_of(const StoredResults& results, const ResponsePlot& plot, const Runs& runs,
                             const std::string& names, const LineNames& name_of,
                             const ResponseRequest& request) {
  ResponsePlot::Panel panel;
  std::vector<Line> references;
  for (const std::string& name : split_at_plus(names)) {
    const ResultColumn y = find_result_column(results, name);
    if (!panel.columns.empty() && y.unit != panel.columns.front().unit)
      throw UsageError(
          fmt::format("'{}' and '{}' have different units ('{}', '{}'); draw each in its own panel: --y {}",
                      panel.columns.front().name, y.name, panel.columns.front().unit, y.unit,
                      join(split_at_plus(names), ",")));
    for (Line& line : lines_of(runs, plot, y, name_of, request)) panel.lines.push_back(std::move(line));
    if (panel.lines.empty() || panel.lines.back().column != y.name)
      throw UsageError(fmt::format("no run has a number for both '{}' and '{}'", plot.x.name, y.name));
    for (Line& line : references_of(runs, plot.x, y, name_of)) references.push_back(std::move(line));
    panel.columns.push_back(y);
  }
  if (panel.columns.empty()) throw UsageError(fmt::format("--y '{}' names no column", names));
  for (Line& line : references) panel.lines.push_back(std::move(line));
  return panel;
}

}  // namespace

ResponsePlot make_response_plot(const StoredResults& results, const ResponseRequest& request) {
  ResponsePlot plot{.title = results.title, .scene = results.scene, .x = {}, .panels = {}};
  plot.x = find_result_column(results, request.x.empty() ? only_parameter(results) : request.x);
  Runs runs;
  std::vector<StoredRun> ended;
  for (const StoredRun& run : results.runs)
    if (run.has_result()) runs.push_back(&run), ended.push_back(run);
  if (runs.empty()) throw UsageError("no run has a result yet");
  if (std::ranges::none_of(runs, [&](const StoredRun* run) { return plot.x.number(*run).has_value(); }))
    throw UsageError(
        fmt::format("'{}' is not a number in any run; --x needs a column with numbers", plot.x.name));
  LineNames name_of;
  for (const std::string& name : request.by) name_of.by.push_back(find_result_column(results, name));
  if (request.by.empty())
    name_of.distinguishing = distinguishing_columns(ended, column_with(ended.front(), plot.x.name));
  std::set<const StoredRun*> missing;
  for (const std::string& names : request.y) {
    plot.panels.push_back(panel_of(results, plot, runs, names, name_of, request));
    for (const StoredRun* run : runs)
      for (const ResultColumn& y : plot.panels.back().columns)
        if (!y.number(*run) || !plot.x.number(*run)) missing.insert(run);
  }
  plot.without_value = static_cast<int>(missing.size());
  return plot;
}

std::string response_data(const ResponsePlot& plot) {
  std::string text = plot_comment("measures of " + plot.scene);
  const auto named = [](const ResultColumn& column) {
    return column.unit.empty() ? column.name : fmt::format("{}, {}", column.name, column.unit);
  };
  for (const ResponsePlot::Panel& panel : plot.panels)
    for (const Line& line : panel.lines) {
      const auto y = std::ranges::find(panel.columns, line.column, &ResultColumn::name);
      text += plot_comment(line.name) + plot_comment(fmt::format("{}; {}; stable", named(plot.x), named(*y)));
      for (const Point& point : line.points)
        text += fmt::format("{} {} {}\n", exact(point.x), exact(point.y), point.stable ? 1 : 0);
      text += "\n\n";
    }
  return text;
}

namespace {

/// Without the unit. Empty for several columns with a unit: the legend names them.
std::string names_in(const std::vector<ResultColumn>& columns) {
  std::vector<std::string> names;
  if (columns.size() > 1 && !columns.front().unit.empty()) return "";
  for (const ResultColumn& column : columns) {
    names.push_back(column.name);
    std::ranges::replace(names.back(), '_', ' ');
  }
  return join(names);
}

struct PointRange {
  double low = INFINITY, high = -INFINITY;
  double greatest() const { return std::max(std::abs(low), std::abs(high)); }
};

template <class Value>
PointRange interval(const ResponsePlot& plot, const ResponsePlot::Panel* only, bool is_log,
                    const Value& value) {
  PointRange all;
  for (const ResponsePlot::Panel& panel : plot.panels)
    for (const Line& line : panel.lines)
      for (const Point& point : line.points)
        if ((!only || only == &panel) && (!is_log || value(point) > 0))
          all.low = std::min(all.low, value(point)), all.high = std::max(all.high, value(point));
  return all;
}

AxisScale scale_of(const std::string& name, const std::string& unit, double greatest, bool is_log) {
  return unit == "%" ? AxisScale{1, name.empty() ? "%" : name + ", %"}
                     : axis_scale(name, unit, greatest, is_log);
}

std::map<std::string, CurveStyle> styles_of(const ResponsePlot& plot, bool named_by_method) {
  std::vector<std::string> names, methods;
  for (const ResponsePlot::Panel& panel : plot.panels)
    for (const Line& line : panel.lines)
      if (!line.is_reference && std::ranges::find(names, line.name) == names.end())
        names.push_back(line.name), methods.push_back(line.method);
  std::map<std::string, CurveStyle> styles;
  const std::vector<CurveStyle> of_methods = curve_styles(methods);
  for (std::size_t k = 0; k < names.size(); ++k)
    styles[names[k]] = named_by_method ? of_methods[k] : numbered_style(k);
  return styles;
}

struct ResponseDrawing {
  const ResponsePlot& plot;
  const PlotLook& look;
  AxisScale x;
  std::map<std::string, CurveStyle> styles;
  std::vector<PanelPlot::Entry> legend{};
  std::size_t block = 0;
  bool any_unstable = false;

  void add_entry(const std::string& name, const std::string& style) {
    const PanelPlot::Entry entry{shortened(name), style};
    if (std::ranges::find(legend, entry) == legend.end()) legend.push_back(entry);
  }

  /// Black dashes, or a cross for a single point.
  void add_reference(PanelPlot::Panel& panel, const std::string& points, const Line& line) {
    const bool is_single = line.points.size() == 1;
    const std::string style =
        is_single ? "with points pointtype 2 linewidth 1.5 linecolor '#111111'" + point_size("1.3")
                  : std::string(reference_line);
    panel.lines.push_back(fmt::format("{} {} notitle", points, style));
    add_entry(line.name, style);
  }

  void add_line(PanelPlot::Panel& panel, const std::string& points, const std::string& of_unstable,
                const Line& line, std::size_t place, std::size_t columns) {
    CurveStyle style = styles[line.name];
    std::string name = line.name;
    if (columns > 1) style.dash = static_cast<int>(place) + 1, name += ", " + line.column;
    const std::string drawn = fmt::format("with linespoints linewidth 1.5 {} pointtype {}{}", style.line(),
                                          style.filled, point_size("1.2"));
    panel.lines.push_back(fmt::format("{} {} notitle", points, drawn));
    add_entry(name, drawn);
    if (std::ranges::all_of(line.points, &Point::stable)) return;
    any_unstable = true;
    panel.lines.push_back(fmt::format("{} with points pointtype {} linecolor '#ffffff'{} notitle",
                                      of_unstable, style.filled, point_size("1.2")));
    panel.lines.push_back(fmt::format("{} with points pointtype {} linewidth 1.5 linecolor '{}'{} notitle",
                                      of_unstable, style.open, style.color, point_size("1.2")));
  }

  PanelPlot::Panel panel_of(const ResponsePlot::Panel& given) {
    const PointRange values = interval(plot, &given, look.log_y, [](const Point& p) { return p.y; });
    const AxisScale y =
        scale_of(names_in(given.columns), given.columns.front().unit, values.greatest(), look.log_y);
    PanelPlot::Panel panel{
        .label = y.label, .low = y.factor * values.low, .high = y.factor * values.high, .lines = {}};
    for (const Line& line : given.lines) {
      const std::string begin = fmt::format("data index {} using ($1*{}):", block++, exact(x.factor));
      const std::string points = fmt::format("{}($2*{})", begin, exact(y.factor));
      const auto place =
          std::ranges::find(given.columns, line.column, &ResultColumn::name) - given.columns.begin();
      if (line.is_reference)
        add_reference(panel, points, line);
      else
        add_line(panel, points, fmt::format("{}($3 == 0 ? $2*{} : NaN)", begin, exact(y.factor)), line,
                 static_cast<std::size_t>(place), given.columns.size());
    }
    return panel;
  }
};

void refuse_log_of_nothing(bool is_log, const std::string& axis, const PointRange& positive) {
  if (is_log && positive.low > positive.high)
    throw UsageError(fmt::format("no value at the {0} axis is positive; leave out --log {0}", axis));
}

}  // namespace

std::string response_script(const ResponsePlot& plot, const PlotFiles& files, const PlotLook& look) {
  const PointRange x = interval(plot, nullptr, look.log_x, [](const Point& p) { return p.x; });
  refuse_log_of_nothing(look.log_x, "x", x);
  for (const ResponsePlot::Panel& panel : plot.panels)
    refuse_log_of_nothing(look.log_y, "y",
                          interval(plot, &panel, look.log_y, [](const Point& p) { return p.y; }));
  std::set<std::string> methods, names;
  for (const ResponsePlot::Panel& panel : plot.panels)
    for (const Line& line : panel.lines)
      if (!line.is_reference) methods.insert(line.method), names.insert(line.name);
  std::string label = plot.x.name;
  std::ranges::replace(label, '_', ' ');
  ResponseDrawing drawing{.plot = plot,
                          .look = look,
                          .x = scale_of(label, plot.x.unit, x.greatest(), look.log_x),
                          .styles = styles_of(plot, methods.size() > 1 || names.size() == 1)};
  PanelPlot drawn{.title = plot.title,
                  .x_label = drawing.x.label,
                  .x_low = drawing.x.factor * x.low,
                  .x_high = drawing.x.factor * x.high,
                  .panels = {},
                  .legend = {}};
  for (const ResponsePlot::Panel& panel : plot.panels) drawn.panels.push_back(drawing.panel_of(panel));
  drawn.legend = drawing.legend;
  if (drawing.any_unstable)
    drawn.legend.push_back({"open: not stable",
                            "with points pointtype 6 linewidth 1.5 linecolor '#555555'" + point_size("1.2")});
  drawn.is_tall = drawn.has_markers = true;
  return panel_script(drawn, files, look);
}

}  // namespace taut::cli
