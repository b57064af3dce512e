#include "cli/study/history_plot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

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
  constexpr double greatest = 1e290;  // gnuplot computes with the length of an axis and room beyond its ends
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
      throw UsageError("there is no row with a number of both '" + columns[0].name + "' and '" +
                       columns[k].name + "'");
  return rows;
}

/// Those of equal names are told apart by their folders.
void tell_apart(HistoryPlot& plot, const std::vector<StoredRun>& runs) {
  std::map<std::string, int> uses;
  for (const HistoryPlot::Curve& curve : plot.curves) ++uses[curve.name];
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (uses[plot.curves[k].name] > 1)
      plot.curves[k].name +=
          ", " + std::filesystem::absolute(runs[k].folder() + "/").parent_path().filename().string();
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

constexpr int above = 45, below = 30;            // pixels, around all panels
constexpr int inside_top = 8, inside_foot = 34;  // of a panel
constexpr int name_height = 21, most_named = 100;

/// A picture without panels whose legend may be as high as all of it.
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
  for (const HistoryPlot::Curve& curve : plot.curves) {
    names.push_back(shortened(curve.name));
    methods.push_back(curve.method);
  }
  const std::vector<CurveStyle> styles = curve_styles(methods);
  std::string text = plot_head(files, plot_width, static_cast<int>(total));
  if (!named)
    text += plot_note(
        std::to_string(curves) + " runs; their names are in " + files.data().filename().string(), 8 / total);
  text += "set multiplot title " + titled(plot.title) + "\n";
  text += named ? legend(names, styles, static_cast<int>(total)) : "unset key\n";
  text += "set lmargin at screen 0.085\nset rmargin at screen " + exact(named ? right_margin(names) : 0.97) +
          "\nset border 3 back linecolor '#444444'\n";
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
