#include "cli/study/history_plot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

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
  if (found == table.columns.end())
    throw UsageError(unknown_name("column of history.csv", name, table.columns));
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
      throw UsageError("no row has numbers in both columns '" + columns[0].name + "' and '" +
                       columns[k].name + "'");
  return rows;
}

void tell_apart(HistoryPlot& plot, const std::vector<StoredRun>& runs) {
  std::map<std::string, int> uses;
  for (const HistoryPlot::Curve& curve : plot.curves) ++uses[curve.name];
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (uses[plot.curves[k].name] > 1)
      plot.curves[k].name +=
          ", " + std::filesystem::absolute(runs[k].folder() + "/").parent_path().filename().string();
}

/// Sorts by a single swept number; `plot DIR/*` sorts by folder name.
void put_in_order(HistoryPlot& plot) {
  const auto number = [](const HistoryPlot::Curve& curve) {
    return parsed<double>(curve.name.substr(curve.name.rfind('=') + 1));
  };
  const auto begins_alike = [&](const HistoryPlot::Curve& curve) {
    const auto of_name = [](const HistoryPlot::Curve& c) { return c.name.substr(0, c.name.rfind('=')); };
    return of_name(curve) == of_name(plot.curves.front()) && number(curve);
  };
  if (!std::ranges::all_of(plot.curves, begins_alike)) return;
  std::ranges::stable_sort(plot.curves, {}, [&](const HistoryPlot::Curve& curve) { return *number(curve); });
}

}  // namespace

HistoryPlot make_history_plot(const StoredResults& results, const std::vector<HistoryColumn>& columns,
                              const HistoryColumn& x) {
  HistoryPlot plot{.title = results.title, .scene = results.scene, .x = x, .columns = columns, .curves = {}};
  std::vector<HistoryColumn> all{x};
  all.insert(all.end(), columns.begin(), columns.end());
  const std::vector<std::string> distinguishing = distinguishing_columns(results.runs, "");
  for (const StoredRun& run : results.runs) {
    const auto file = std::filesystem::path(run.folder()) / "history.csv";
    const CsvTable history = read_csv(file);
    if (history.rows.empty()) throw UsageError("'" + file.string() + "' has no rows yet");
    try {
      plot.curves.push_back({series_name(run, distinguishing), run.method(), rows_of(history, all)});
    } catch (const UsageError& error) {
      throw UsageError(file.string() + ": " + error.what());
    }
  }
  tell_apart(plot, results.runs);
  put_in_order(plot);
  return plot;
}

std::string history_data(const HistoryPlot& plot) {
  std::string text;
  for (const HistoryPlot::Curve& curve : plot.curves) {
    std::string heading = plot.x.label;
    for (const HistoryColumn& column : plot.columns) heading += "; " + column.label;
    text += plot_comment(curve.name) + plot_comment(heading);
    for (const auto& row : curve.rows) {
      for (const double value : row) text += (std::isfinite(value) ? exact(value) : "NaN") + " ";
      text.back() = '\n';
    }
    text += "\n\n";
  }
  return text;
}

namespace {

constexpr int above = 45, below = 30;            // pixels
constexpr int inside_top = 8, inside_foot = 34;  // pixels, per panel
constexpr int name_height = 21, most_named = 100;

/// An empty plot, whose legend can use the full height.
std::string legend(const std::vector<std::string>& names, const std::vector<CurveStyle>& styles, int total) {
  std::vector<std::string> entries{"NaN notitle"};
  for (std::size_t k = 0; k < names.size(); ++k)
    entries.push_back("keyentry with lines linewidth 1.5 " + styles[k].line() + " title " +
                      plot_text(names[k]));
  return fmt::format(
             "set key at screen {}, screen {} left top Left reverse samplen 4 spacing 1.25 maxrows {}\n"
             "set margins 0, 0, 0, 0\nunset border\nunset tics\n",
             right_margin(names) + 0.008, 1 - static_cast<double>(above) / total, names.size()) +
         "plot [0:1] [0:1] " + join(entries, ", \\\n     ") + "\nunset key\nset tics\n";
}

bool is_of_one_method(const HistoryPlot& plot) {
  return plot.curves.size() > 1 && std::ranges::all_of(plot.curves, [&](const HistoryPlot::Curve& curve) {
           return curve.name.starts_with(plot.curves.front().method + ", ");
         });
}

/// Approximate width of tick labels, pixels.
double width_of_ticks(const HistoryPlot& plot, std::size_t column) {
  double low = INFINITY, high = -INFINITY;
  for (const HistoryPlot::Curve& curve : plot.curves)
    for (const auto& row : curve.rows)
      if (std::isfinite(row[0]) && std::isfinite(row[column]))
        low = std::min(low, row[column]), high = std::max(high, row[column]);
  if (!(high > low)) return text_width(fmt::format("{:g}", low), axis_font);
  const double power = std::pow(10, std::floor(std::log10(high - low)) - 1);
  const double step = (high - low > 50 * power ? 5 : 2) * power;  // as wide as gnuplot's, or less
  std::vector<std::string> numbers;
  for (const double end : {low, high})
    for (const double way : {-2, -1, 0, 1, 2})
      numbers.push_back(fmt::format("{:g}", step * (std::round(end / step) + way)));
  return text_width(numbers, axis_font);
}

double left_margin(const HistoryPlot& plot) {
  constexpr double label = 44, least = 109;  // pixels
  double widest = 0;
  for (std::size_t k = 0; k < plot.columns.size(); ++k)
    widest = std::max(widest, width_of_ticks(plot, k + 1));
  return std::max(label + widest, least) / plot_width;
}

}  // namespace

std::string history_script(const HistoryPlot& plot, const PlotFiles& files) {
  constexpr int greatest_height = 300, least_height = 140, most_together = 2400;  // pixels
  const auto panels = static_cast<int>(plot.columns.size()), curves = static_cast<int>(plot.curves.size());
  const bool named = curves <= most_named;
  const int of_names = named ? name_height * (curves + 1) : 0;
  const int height =
      std::max(std::clamp(most_together / panels, least_height, greatest_height), of_names / panels);
  const double total = above + height * panels + below;
  std::vector<std::string> names, methods;
  const bool of_one = is_of_one_method(plot);
  for (const HistoryPlot::Curve& curve : plot.curves) {
    names.push_back(shortened(of_one ? curve.name.substr(curve.method.size() + 2) : curve.name));
    methods.push_back(curve.method);
  }
  const std::vector<CurveStyle> styles = line_styles(methods);
  std::string text = plot_head(files, plot_width, static_cast<int>(total));
  if (!named)
    text += plot_note(
        std::to_string(curves) + " runs; their names are in " + files.data().filename().string(), 8 / total);
  text += "set multiplot title " + titled(of_one ? plot.title + ", " + methods.front() : plot.title) + "\n";
  text += named ? legend(names, styles, static_cast<int>(total)) : "unset key\n";
  text += "set lmargin at screen " + exact(left_margin(plot)) + "\nset rmargin at screen " +
          exact(named ? right_margin(names) : 0.97) + "\nset border 3 back linecolor '#444444'\n";
  text += "set grid back linetype 1 linecolor '#e4e4e4'\nset tics nomirror\nset autoscale xfix\n";
  for (int column = 0; column < panels; ++column) {
    const double top = above + height * column;
    text += fmt::format("set tmargin at screen {}\nset bmargin at screen {}\n",
                        1 - (top + inside_top) / total, 1 - (top + height - inside_foot) / total);
    std::vector<std::string> lines;
    for (std::size_t k = 0; k < plot.curves.size(); ++k)
      lines.push_back("data index " + std::to_string(k) + " using 1:" + std::to_string(column + 2) +
                      " with lines linewidth 1.5 " + styles[k].line() + " notitle");
    if (column + 1 == panels) text += "set xlabel " + plot_text(plot.x.label) + "\n";
    const std::string& label = plot.columns[static_cast<std::size_t>(column)].label;
    text += "set ylabel " + plot_text(label) +
            fmt::format(" font ',{}'\nplot ", font_that_fits(label, 0.8 * height, 11)) +
            join(lines, ", \\\n     ") + "\nunset label\n";
  }
  return text + "unset multiplot\n";
}

}  // namespace taut::cli
