#include "cli/study/study_tables.hpp"

#include "cli/study/chart_errors.hpp"
#include "cli/study/chart_tables.hpp"
#include "cli/text/format.hpp"
#include "cli/text/markdown.hpp"

namespace taut::cli {
namespace {

/// "0.2543 s (0.07 %)": value, error.
std::string measure_cell(const StoredRun& run, const std::string& measure) {
  const auto value = run.number(measure_column(measure, "value"));
  if (!value) return "-";
  const std::string unit = run.text(measure_column(measure, "unit"));
  std::string text = brief(*value) + (unit.empty() || unit == "1" ? "" : " " + unit);
  const auto error = run.number(measure_column(measure, "error")),
             reference = run.number(measure_column(measure, "reference"));
  if (error && reference && *reference != 0) text += " (" + percent(*error) + ")";
  return text;
}

std::string measures_of_runs(const StoredResults& results) {
  const std::vector<std::string> columns = distinguishing_columns(results.runs, ""),
                                 measures = results.measures();
  std::vector<std::vector<std::string>> rows{{"run", "verdict"}};
  rows[0].insert(rows[0].end(), measures.begin(), measures.end());
  for (const StoredRun& run : results.runs) {
    if (!run.has_result()) continue;
    rows.push_back({"`" + series_name(run, columns) + "`", run.text("verdict")});
    for (const std::string& measure : measures) rows.back().push_back(measure_cell(run, measure));
  }
  return "**" + results.title + "**: measures, and in brackets their errors against the references\n\n" +
         markdown_table(rows);
}

}  // namespace

std::string study_tables(const StudyPictures& pictures, const std::vector<std::string>& results) {
  const StoredResults all = read_results(results);
  std::string page = "# " + all.title + "\n\nMade by `taut sweep` from the stored results; do not edit.\n";
  for (const StudyPictures::Charted& chart : pictures.charts) {
    const Chart charted = make_chart(all, chart.request);
    page += "\n" + markdown(charted);
    if (const std::string prices = markdown_of_prices(charted); !prices.empty()) page += "\n" + prices;
  }
  if (pictures.map) page += "\n" + markdown(make_map(all, pictures.map->request));
  if (!pictures.history.empty()) page += "\n" + measures_of_runs(all);
  return page;
}

}  // namespace taut::cli
