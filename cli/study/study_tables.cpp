#include "cli/study/study_tables.hpp"

#include <fmt/core.h>

#include "cli/study/chart_tables.hpp"
#include "cli/text/format.hpp"
#include "cli/text/markdown.hpp"

namespace taut::cli {
namespace {

/// "0.2543 s (0.07 %)".
std::string measure_cell(const StoredRun& run, const std::string& measure) {
  const MeasureResult& m = run.record.measure(measure);
  if (!m.value) return "-";
  std::string text = brief(*m.value);
  if (!m.unit.empty() && m.unit != "1") text += " " + m.unit;
  if (m.error && m.reference && *m.reference != 0) text += fmt::format(" ({})", percent(*m.error));
  return text;
}

std::string measures_of_runs(const StoredResults& results) {
  const std::vector<std::string> columns = distinguishing_columns(results.runs, ""),
                                 measures = results.measures();
  std::vector<std::vector<std::string>> rows{{"run", "verdict"}};
  rows[0].insert(rows[0].end(), measures.begin(), measures.end());
  for (const StoredRun& run : results.runs) {
    if (!run.has_result()) continue;
    rows.push_back({fmt::format("`{}`", series_name(run, columns)), run.verdict()});
    for (const std::string& measure : measures) rows.back().push_back(measure_cell(run, measure));
  }
  return fmt::format("**{}**: measures, and in brackets their errors against the references\n\n{}",
                     results.title, markdown_table(rows));
}

}  // namespace

std::string study_tables(const StudyPictures& pictures, const std::vector<std::string>& results) {
  const StoredResults all = read_results(results);
  std::string page =
      fmt::format("# {}\n\nMade by `taut sweep` from the stored results; do not edit.\n", all.title);
  for (const StudyPictures::Charted& chart : pictures.charts) try {
      const Chart charted = make_chart(all, chart.request);
      page += "\n" + markdown(charted);
      if (const std::string prices = markdown_of_prices(charted); !prices.empty()) page += "\n" + prices;
    } catch (const NoErrors&) {
      // draw_pictures() reports charts without errors
    }
  if (pictures.map) page += "\n" + markdown(make_map(all, pictures.map->request));
  if (!pictures.history.empty()) page += "\n" + measures_of_runs(all);
  return page;
}

}  // namespace taut::cli
