#include "cli/study/chart_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "cli/study/chart_tables.hpp"
#include "cli/study/curve_style.hpp"
#include "cli/study/panel_plot.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

// limits of axes: gnuplot computes beyond both ends
constexpr double least = 1e-290, greatest = 1e290;
// heights in pixels: plot, row of the strip, title, axis, note
constexpr double field = 520, row = 17, above = 52, below = 69, note = 21;

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> errors_in_words{
    {{"rmse", "RMS error"},
     {"line_rmse", "RMS error along the line"},
     {"line_error", "relative RMS error along the line"},
     {"field_rmse", "RMS error"},
     {"field_error", "greatest error"},
     {"path_error", "error of the path"}}};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0;

  void include(double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Shows two ticks.
  Range wide() const {
    if (high == 0) return {0.13, 13};  // no tick at an end
    const double margin = std::max(1.4, std::sqrt(6 / (high / low)));
    return {std::clamp(low / margin, least, greatest / 6), std::clamp(high * margin, least * 6, greatest)};
  }
  double centre() const { return std::sqrt(low) * std::sqrt(high); }
  double decades() const { return std::log10(high) - std::log10(low); }
};

double scale(const Chart& chart) { return chart.unit.empty() ? 100 : 1; }

bool has_no_error(const ChartPoint& point) { return !point.error; }

struct Layout {
  Range error, cost;
  std::vector<std::string> names;
  std::vector<CurveStyle> styles;
  std::vector<int> strip_row;
  int strip_rows = 0;
  int notes = 0;

  double foot() const { return below + note * notes; }
  double height() const { return above + row * strip_rows + field + foot(); }
  double in_strip(double rows_above_field) const {
    return error.high * std::pow(10, error.decades() * row * rows_above_field / field);
  }
  double end() const { return in_strip(strip_rows); }
};

Layout layout_of(const Chart& chart) {
  Layout layout;
  layout.notes = static_cast<int>(footnotes(chart).size());
  std::vector<std::string> methods;
  for (const ChartSeries& series : chart.series) {
    methods.push_back(series.method);
    layout.names.push_back(shortened(series.name));
    for (const ChartPoint& point : series.points) {
      layout.cost.include(point.cost);
      if (point.error) layout.error.include(scale(chart) * *point.error);
    }
    const bool none = std::ranges::any_of(series.points, has_no_error);
    layout.strip_row.push_back(none ? layout.strip_rows++ : -1);
  }
  layout.styles = curve_styles(methods);
  layout.error = layout.error.wide();
  layout.cost = layout.cost.wide();
  return layout;
}

/// "diameter" of "diameter_rmse".
std::string in_words(const Chart& chart, std::string name) {
  if (const std::string end = "_" + chart.kind; name.ends_with(end)) name.resize(name.size() - end.size());
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// "RMS error of the diameter, %".
std::string words_of_error(const Chart& chart) {
  const std::string unit = chart.unit.empty() ? "%" : chart.unit;
  const std::string name = in_words(chart, chart.measure);
  if (!chart.against.empty())
    return fmt::format("difference of the {} from {}, {}", name, chart.against, unit);
  const auto kind =
      std::ranges::find(errors_in_words, chart.kind, &std::pair<std::string_view, std::string_view>::first);
  if (kind != errors_in_words.end()) return fmt::format("{} of the {}, {}", kind->second, name, unit);
  return fmt::format("error of the {}, {}", name,
                     chart.unit.empty() && chart.relative ? "% of the reference" : unit);
}

std::string frame(const Chart& chart, const Layout& layout) {
  const std::vector<std::string> notes = footnotes(chart);
  const double height = layout.height();
  std::string text = plot_title(chart.title);
  text += fmt::format("set tmargin screen {}\nset bmargin screen {}\nset lmargin screen 0.075\n",
                      1 - above / height, layout.foot() / height);
  text += fmt::format("set rmargin screen {}\n", right_margin(layout.names));
  // gnuplot puts entries beyond the height of the graph outside the picture. An entry is 17.1 pixels high at spacing 1.
  // 4: two slopes and two kinds of markers
  const double entries = static_cast<double>(layout.names.size()) + 4, graph = height - above - layout.foot();
  text += fmt::format("set key at screen {}, screen {} left top Left reverse samplen 4 spacing {}\n",
                      right_margin(layout.names) + 0.008, (layout.foot() + field) / height,
                      brief(std::min(1.2, graph / (17.1 * entries))));
  text += "set border 3 back linecolor '#444444'\nset logscale xy\n";
  text += "set grid back linetype 1 linecolor '#e4e4e4'\nset tics nomirror\n";
  text += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", exact(layout.cost.low),
                      exact(layout.cost.high), exact(layout.error.low), exact(layout.end()));
  text += fmt::format("set xtics {}\nset ytics {}\n",
                      log_ticks(layout.cost.low, layout.cost.high, is_time(chart.cost) ? brief : with_prefix),
                      log_ticks(layout.error.low, layout.error.high, brief));
  text += fmt::format("set xlabel {}\nset ylabel {}\n", plot_text(label(chart.cost)),
                      plot_text(words_of_error(chart)));
  for (std::size_t k = 0; k < notes.size(); ++k)
    text += plot_note(notes[k], (16 + note * static_cast<double>(notes.size() - 1 - k)) / height);
  return text;
}

std::string strip(const Layout& layout) {
  if (layout.strip_rows == 0) return "";
  std::string text = fmt::format(
      "set object rectangle from graph 0, first {} to graph 1, "
      "graph 1 behind fillcolor '#f3f3f3' fillstyle solid noborder\n"
      "set label 'no error' at graph -0.01, first {} right font ',9' textcolor '#555555'\n",
      exact(layout.error.high), exact(layout.in_strip(0.5 * layout.strip_rows)));
  for (std::size_t k = 0; k < layout.names.size(); ++k)
    if (const int place = layout.strip_row[k]; place >= 0)
      text +=
          fmt::format("set label {} at graph 1.01, first {} left font ',9' textcolor '#222222'\n",
                      plot_text(layout.names[k]), exact(layout.in_strip(layout.strip_rows - place - 0.5)));
  return text;
}

/// At order p, error ∝ cost^(−p/(dim + 1)): particles grow as 1/dp^dim, steps as 1/dp.
std::string guide(const Chart& chart, const Layout& layout, int order) {
  const double slope = -order / (chart.dim + 1.0);
  return fmt::format(
      "{} * (x / {})**({}) with lines linewidth 1.5 linecolor '#a0a0a0' dashtype {} title 'slope of order {}'",
      exact(layout.error.centre()), exact(layout.cost.centre()), exact(slope), order + 1, order);
}

/// Thin line: all runs; thick line: stable runs.
std::vector<std::string> curve(const Chart& chart, const Layout& layout, std::size_t k) {
  const auto& points = chart.series[k].points;
  const CurveStyle& style = layout.styles[k];
  const std::string y = fmt::format("($2 > 0 ? $2*{} : {})", exact(scale(chart)), exact(layout.error.low));
  const std::string x = fmt::format("($3 > 0 ? $3 : {})", exact(layout.cost.low));
  const auto at = [&](const std::string& condition, const std::string& height) {
    return fmt::format("data index {} using {}:({} ? {} : NaN)", k, x, condition, height);
  };
  const auto markers = [&](const std::string& with, const std::string& height, const char* size,
                           const std::string& offset) {
    const std::string open = at(with + " && $4 == 0", height), of_size = point_size(size);
    std::vector<std::string> all;
    if (std::ranges::any_of(points, [](const ChartPoint& p) { return p.stable; }))
      all.push_back(fmt::format("{} with points {}{} notitle", at(with + " && $4 == 1", height),
                                style.marker(), of_size));
    if (std::ranges::all_of(points, [](const ChartPoint& p) { return p.stable; })) return all;
    all.push_back(fmt::format("{} with points pointtype {} linecolor '#ffffff'{} notitle", open, style.filled,
                              of_size));
    all.push_back(fmt::format("{} with points pointtype {} linewidth 1.5 linecolor '{}'{} notitle", open,
                              style.open, style.color, of_size));
    all.push_back(fmt::format(
        "{}:('×') with labels offset character {} font ',11' textcolor '#d00000' notitle", open, offset));
    return all;
  };
  std::vector<std::string> all;
  if (!std::ranges::all_of(points, has_no_error)) {
    if (!std::ranges::all_of(points, &ChartPoint::stable))
      all.push_back(fmt::format("{} with lines linewidth 0.7 {} notitle", at("$5 == 1", y), style.line()));
    all.push_back(
        fmt::format("{} with lines linewidth 2 {} notitle", at("$5 == 1 && $4 == 1", y), style.line()));
    for (std::string& each : markers("$5 == 1", y, "1.3", "0.9,0.45")) all.push_back(std::move(each));
    if (std::ranges::any_of(points, &ChartPoint::by_chance))
      all.push_back(fmt::format("{} with points pointtype 7 linecolor '#ffffff'{} notitle", at("$8 == 1", y),
                                point_size("0.5")));
  }
  if (const int place = layout.strip_row[k]; place >= 0)
    for (std::string& each :
         markers("$5 == 0", exact(layout.in_strip(layout.strip_rows - place - 0.5)), "1.1", "0.9,0"))
      all.push_back(std::move(each));
  return all;
}

std::vector<std::string> legend(const Chart& chart, const Layout& layout) {
  std::vector<std::string> all;
  bool all_stable = true, chance = false;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const CurveStyle& style = layout.styles[k];
    const auto& points = chart.series[k].points;
    all_stable &= std::ranges::all_of(points, &ChartPoint::stable);
    chance |= std::ranges::any_of(points, &ChartPoint::by_chance);
    if (std::ranges::all_of(points, has_no_error)) continue;  // named in the strip
    all.push_back(fmt::format("keyentry with linespoints linewidth 2{} {} pointtype {} title {}",
                              point_size("1.3"), style.line(), style.filled, plot_text(layout.names[k])));
  }
  if (!all_stable)
    all.push_back(fmt::format(
        "keyentry with points pointtype 6 linewidth 1.5{} linecolor '#555555' title 'open, ×: not stable'",
        point_size("1.3")));
  if (chance)
    all.emplace_back(
        "keyentry with points pointtype 6 linewidth 3.5 linecolor '#555555' title 'dot: finer run worse'");
  return all;
}

}  // namespace

std::string chart_data(const Chart& chart) {
  std::string text = plot_comment(fmt::format("{} of {}", chart.measure, chart.scene));
  for (const ChartSeries& series : chart.series) {
    text += plot_comment(series.name) +
            plot_comment(fmt::format(
                "spacing, m; error{}; {}; stable; has an error; verdict; run; a finer run is worse",
                chart.unit.empty() ? "" : ", " + chart.unit, label(chart.cost)));
    for (const ChartPoint& point : series.points)
      text += fmt::format("{} {} {} {} {} {} {} {}\n", exact(point.spacing),
                          point.error ? exact(*point.error) : "NaN", exact(point.cost), point.stable ? 1 : 0,
                          point.error ? 1 : 0, point.verdict.empty() ? "-" : point.verdict,
                          data_text(point.folder), point.by_chance ? 1 : 0);
    text += "\n\n";
  }
  return text;
}

std::string chart_script(const Chart& chart, const PlotFiles& files) {
  if (chart.series.size() > most_marked_lines())
    throw UsageError(
        fmt::format("the chart would have {} lines, such as '{}'; at most {} are allowed; "
                    "choose some with --methods, or draw a map",
                    chart.series.size(), chart.series.front().name, most_marked_lines()));
  const Layout layout = layout_of(chart);
  std::vector<std::string> plots{guide(chart, layout, 1), guide(chart, layout, 2)};
  for (std::size_t k = 0; k < chart.series.size(); ++k)
    for (std::string& each : curve(chart, layout, k)) plots.push_back(std::move(each));
  for (std::string& each : legend(chart, layout)) plots.push_back(std::move(each));
  return fmt::format("{}{}{}plot [{}:{}] {}\n",
                     plot_head(files, plot_width, static_cast<int>(layout.height())), frame(chart, layout),
                     strip(layout), exact(layout.cost.low), exact(layout.cost.high),
                     join(plots, ", \\\n     "));
}

}  // namespace taut::cli
