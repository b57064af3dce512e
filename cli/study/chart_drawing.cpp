#include "cli/study/chart_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

constexpr int width = 1280, height = 800;  // pixels
constexpr std::size_t most_series = 24;    // whose names the picture has room for

/// Least and greatest of positive numbers.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// With a margin on both sides, and wide enough for two ticks.
  Range wide() const {
    const double margin = std::max(1.4, std::sqrt(6 / (high / low)));
    return {low / margin, high * margin};
  }
  double centre() const { return std::sqrt(low * high); }
};

/// Errors as drawn: shares in percent.
double scale(const Chart& chart) { return chart.unit.empty() ? 100 : 1; }

struct Ranges {
  Range error, cost;
  bool some_without_error = false;

  /// The strip at the right of those without an error, as wide as its heading.
  double end() const {
    return some_without_error ? error.high * std::pow(error.high / error.low, 0.08) : error.high;
  }
  double in_strip() const { return std::sqrt(error.high * end()); }
};

Ranges ranges_of(const Chart& chart) {
  Ranges ranges;
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points) {
      ranges.cost.include(point.cost);
      if (point.error) ranges.error.include(scale(chart) * *point.error);
      ranges.some_without_error |= !point.error;
    }
  return {ranges.error.wide(), ranges.cost.wide(), ranges.some_without_error};
}

/// 1, 2 and 5 of each decade, or its start alone where there are many decades.
std::string ticks(const Range& range, std::string (*show)(double)) {
  const bool many = range.high / range.low > 3e3;
  std::vector<std::string> all;
  for (int decade = static_cast<int>(std::floor(std::log10(range.low))); std::pow(10, decade) <= range.high;
       ++decade)
    for (const double digit : {1, 2, 5}) {
      const double tick = digit * std::pow(10, decade);
      if (tick < range.low || tick > range.high || (many && digit > 1)) continue;
      all.push_back(plot_text(show(tick)) + " " + brief(tick));
    }
  return std::string("(").append(join(all)).append(")");
}

std::string error_label(const Chart& chart) {
  if (!chart.unit.empty()) return chart.measure + ", " + chart.unit;
  return chart.relative ? "error of " + chart.measure + ", % of the reference" : chart.measure + ", %";
}

/// What holds for the whole chart, in small print below it.
std::vector<std::string> footnotes(const Chart& chart) {
  Range spacing;
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points) spacing.include(point.spacing);
  std::vector<std::string> notes{"Scene " + chart.scene + ", particles " + brief(spacing.high) + " to " +
                                 brief(spacing.low) +
                                 " m apart; each line runs from coarse (below) to fine."};
  notes.push_back("Reference: " + join(chart.references, "; "));
  if (chart.cost == Cost::seconds) notes.push_back("Time: " + join(chart.machines, "; "));
  return notes;
}

std::string frame(const Chart& chart, const Ranges& ranges) {
  const std::vector<std::string> notes = footnotes(chart);
  std::string text = plot_title(chart.title);
  text += "set key outside right top Left reverse samplen 2 spacing 1.25\n";
  text += "set bmargin screen 0.17\nset lmargin screen 0.075\nset border 3 back linecolor '#444444'\n";
  text += "set logscale xy\nset grid back linetype 1 linecolor '#e4e4e4'\nset tics nomirror\n";
  text += "set xrange [" + exact(ranges.error.low) + ":" + exact(ranges.end()) + "]\n";
  text += "set yrange [" + exact(ranges.cost.low) + ":" + exact(ranges.cost.high) + "]\n";
  text += "set xtics " + ticks(ranges.error, brief) + "\n";
  text += "set ytics " + ticks(ranges.cost, chart.cost == Cost::seconds ? brief : with_prefix) + "\n";
  text += "set xlabel " + plot_text(error_label(chart)) + "\n";
  text += "set ylabel " + plot_text(label(chart.cost)) + "\n";
  for (std::size_t k = 0; k < notes.size(); ++k)
    text += plot_note(notes[k], 0.075 - 0.027 * static_cast<double>(k));
  return text;
}

/// The strip of the runs that have a cost but no error.
std::string strip(const Ranges& ranges) {
  if (!ranges.some_without_error) return "";
  return "set object rectangle from " + exact(ranges.error.high) +
         ", graph 0 to graph 1, graph 1 behind fillcolor '#f3f3f3' fillstyle solid noborder\n"
         "set label 'no value' at " +
         exact(ranges.in_strip()) + ", graph 0.98 center font ',9' textcolor '#555555'\n";
}

/// The cost of an error e with convergence of order p is e^(−(dim + 1)/p): particles grow as 1/dp^dim, steps
/// as 1/dp.
std::string guide(const Chart& chart, const Ranges& ranges, int order) {
  const double slope = -(chart.dim + 1.0) / order;
  return exact(ranges.cost.centre()) + " * (x / " + exact(ranges.error.centre()) + ")**(" + exact(slope) +
         ") with lines linewidth 1.5 linecolor '#a0a0a0' dashtype " + std::to_string(order + 1) +
         " title 'slope of order " + std::to_string(order) + "'";
}

std::vector<std::string> curves(const Chart& chart, const Ranges& ranges) {
  std::vector<std::string> all{guide(chart, ranges, 1), guide(chart, ranges, 2)};
  const std::string factor = exact(scale(chart));
  const std::string nowhere = exact(ranges.in_strip());
  bool any_unstable = false;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const std::string marker = marker_style(k) + " " + line_style(k);
    const std::string block = "data index " + std::to_string(k) + " using ";
    all.push_back(block + "($2*" + factor + "):3 with linespoints linewidth 2 " + marker + " title " +
                  plot_text(chart.series[k].name));
    const auto& points = chart.series[k].points;
    any_unstable |= std::ranges::count(points, false, &ChartPoint::stable) > 0;
    if (std::ranges::any_of(points, [](const ChartPoint& p) { return !p.error; }))
      all.push_back(block + "($5 == 1 ? NaN : " + nowhere + "):3 with points " + marker + " notitle");
  }
  if (any_unstable)
    all.push_back(
        "data using ($4 == 1 ? NaN : $5 == 1 ? $2*" + factor + " : " + nowhere +
        "):3 with points pointtype 2 pointsize 2.6 linewidth 2 linecolor '#d00000' title 'not stable'");
  return all;
}

}  // namespace

std::string chart_data(const Chart& chart) {
  std::string text = "# " + chart.measure + " of " + chart.scene + "\n";
  for (const ChartSeries& series : chart.series) {
    text += "# " + series.name + "\n# spacing, m; error" + (chart.unit.empty() ? "" : ", " + chart.unit) +
            "; " + label(chart.cost) + "; stable; has an error; verdict; run\n";
    for (const ChartPoint& point : series.points)
      text += exact(point.spacing) + " " + (point.error ? exact(*point.error) : "NaN") + " " +
              exact(point.cost) + " " + (point.stable ? "1 " : "0 ") + (point.error ? "1 " : "0 ") +
              point.verdict + " \"" + point.folder + "\"\n";
    text += "\n\n";
  }
  return text;
}

std::string chart_script(const Chart& chart, const PlotFiles& files) {
  if (chart.series.size() > most_series)
    throw UsageError("a chart of " + std::to_string(chart.series.size()) + " lines, such as '" +
                     chart.series.front().name + "', cannot be read: at most " + std::to_string(most_series) +
                     "; leave rows out of results.csv, or draw a map");
  const Ranges ranges = ranges_of(chart);
  return plot_head(files, width, height) + frame(chart, ranges) + strip(ranges) + "plot " +
         join(curves(chart, ranges), ", \\\n     ") + "\n";
}

}  // namespace taut::cli
