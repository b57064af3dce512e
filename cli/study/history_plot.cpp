#include "cli/study/history_plot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/study/csv.hpp"
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
  std::vector<std::size_t> places{column_of(table, "t")};
  for (const HistoryColumn& column : columns) places.push_back(column_of(table, column.name));
  std::vector<std::vector<double>> rows;
  for (const auto& cells : table.rows) {
    rows.emplace_back();
    for (const std::size_t place : places) rows.back().push_back(parsed<double>(cells[place]).value_or(NAN));
  }
  return rows;
}

}  // namespace

HistoryPlot make_history_plot(const StoredResults& results, const std::vector<HistoryColumn>& columns) {
  HistoryPlot plot{.title = results.title, .scene = results.scene, .columns = columns, .curves = {}};
  const std::vector<std::string> distinguishing = distinguishing_columns(results.runs, "");
  for (const StoredRun& run : results.runs) {
    if (!run.has_result()) continue;
    const CsvTable history = read_csv(std::filesystem::path(run.folder()) / "history.csv");
    plot.curves.push_back({series_name(run, distinguishing), rows_of(history, columns)});
  }
  return plot;
}

std::string history_data(const HistoryPlot& plot) {
  std::string text;
  for (const HistoryPlot::Curve& curve : plot.curves) {
    text += "# " + curve.name + "\n# t, s";
    for (const HistoryColumn& column : plot.columns) text += "; " + column.label;
    text += "\n";
    for (const auto& row : curve.rows) {
      for (const double value : row) text += (std::isfinite(value) ? exact(value) : "NaN") + " ";
      text.back() = '\n';
    }
    text += "\n\n";
  }
  return text;
}

std::string history_script(const HistoryPlot& plot, const PlotFiles& files) {
  constexpr int panel_height = 300, around = 60;  // pixels
  const auto panels = plot.columns.size();
  std::string text = plot_head(files, 1280, around + panel_height * static_cast<int>(panels));
  text += "set multiplot layout " + std::to_string(panels) + ",1 title " + plot_text(plot.title) +
          " font ',15'\n";
  text += "set key outside right top Left reverse samplen 2 spacing 1.25\nset lmargin screen 0.085\n";
  text += "set rmargin screen 0.84\nset border 3 back linecolor '#444444'\n";
  text += "set grid back linetype 1 linecolor '#e4e4e4'\nset tics nomirror\nset autoscale xfix\n";
  for (std::size_t column = 0; column < panels; ++column) {
    std::vector<std::string> lines;
    for (std::size_t k = 0; k < plot.curves.size(); ++k)
      lines.push_back("data index " + std::to_string(k) + " using 1:" + std::to_string(column + 2) +
                      " with lines linewidth 1.5 " + line_style(k) + " title " +
                      plot_text(plot.curves[k].name));
    if (column + 1 == panels) text += "set xlabel 't, s'\n";
    text +=
        "set ylabel " + plot_text(plot.columns[column].label) + "\nplot " + join(lines, ", \\\n     ") + "\n";
    text += "unset key\n";
  }
  return text + "unset multiplot\n";
}

}  // namespace taut::cli
