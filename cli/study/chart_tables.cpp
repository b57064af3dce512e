#include "cli/study/chart_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/core.h>

#include "cli/study/chart_errors.hpp"
#include "cli/study/choose.hpp"
#include "cli/text/format.hpp"
#include "cli/text/json.hpp"
#include "cli/text/markdown.hpp"

namespace taut::cli {
namespace {

std::set<double, std::greater<>> spacings(const Chart& chart) {
  std::set<double, std::greater<>> all;
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points) all.insert(point.spacing);
  return all;
}

std::string error_cell(const Chart& chart, const ChartSeries& series, double spacing) {
  const auto point = std::ranges::find(series.points, spacing, &ChartPoint::spacing);
  if (point == series.points.end()) return "";
  const std::string error = point->error ? shown_error(chart, *point->error) : "-";
  return point->stable ? error : fmt::format("{} ({})", error, point->verdict);
}

bool has_zero(const Chart& chart) {
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points)
      if (point.cost == 0 || point.error == 0.0) return true;
  return false;
}

Json point_json(const ChartPoint& point) {
  return {{"spacing", point.spacing},
          {"error", point.error},
          {"cost", point.cost > 0 ? Json(point.cost) : Json()},
          {"verdict", point.verdict},
          {"stable", point.stable},
          {"by_chance", point.by_chance},
          {"cfl", point.cfl},
          {"stepping", point.stepping},
          {"folder", point.folder}};
}

}  // namespace

std::string orders_table(const Chart& chart) {
  std::vector<std::vector<std::string>> rows{{"method", "order", "runs", "finest, m", "its error",
                                              is_time(chart.cost) ? "its s" : "its particles × steps",
                                              "not stable"}};
  for (const ChartSeries& series : chart.series) {
    const ChartPoint& finest = series.points.back();
    const auto unstable = std::ranges::count(series.points, false, &ChartPoint::stable);
    rows.push_back(
        {series.name, series.order ? brief(*series.order) : "-", std::to_string(series.points.size()),
         brief(finest.spacing),
         finest.error ? shown_error(chart, *finest.error) : fmt::format("- ({})", without_error(finest)),
         shown_cost(finest.cost), unstable == 0 ? "" : std::to_string(unstable)});
  }
  return in_columns(rows);
}

std::string markdown(const Chart& chart) {
  std::vector<std::vector<std::string>> rows{{"method"}};
  for (const double spacing : spacings(chart)) rows[0].push_back(shown_spacing(spacing));
  rows[0].insert(rows[0].end(), {"order", is_time(chart.cost) ? "finest, s" : "finest, particles × steps"});
  for (const ChartSeries& series : chart.series) {
    rows.push_back({fmt::format("`{}`", series.name)});
    for (const double spacing : spacings(chart)) rows.back().push_back(error_cell(chart, series, spacing));
    rows.back().insert(rows.back().end(),
                       {series.order ? brief(*series.order) : "-", shown_cost(series.points.back().cost)});
  }
  std::string text = fmt::format("**{}**: {}\n\n{}", chart.title, error_label(chart), markdown_table(rows));
  for (const std::string& note : footnotes(chart)) text += fmt::format("\n{}\n", note);
  return text;
}

std::string markdown_of_prices(const Chart& chart) {
  constexpr std::array levels{0.05, 0.01, 0.005};
  if (!chart.unit.empty() || !is_time(chart.cost)) return "";
  std::vector<std::vector<std::string>> rows{{"method"}};
  for (const double level : levels) rows[0].push_back("within " + shown_error(chart, level));
  for (const ChartSeries& series : chart.series) {
    std::vector<std::string> cells{fmt::format("`{}`", series.name)};
    for (const double level : levels) {
      const std::vector<Offer> offers = suitable_offers(chart, {.error = level, .seconds = {}});
      const auto own = std::ranges::find(offers, &series, &Offer::series);
      cells.push_back(own == offers.end() ? "-"
                                          : fmt::format("{} s at {}", shown_cost(own->point->cost),
                                                        shown_spacing(own->point->spacing)));
    }
    if (std::ranges::any_of(cells, [](const std::string& cell) { return cell.ends_with("m"); }))
      rows.push_back(std::move(cells));
  }
  if (rows.size() == 1) return "";
  return "Cheapest stable run within each error; all finer runs of its method are within it, too:\n\n" +
         markdown_table(rows);
}

std::string chart_json(const Chart& chart) {
  Json json{{"title", chart.title},
            {"scene", chart.scene},
            {"measure", chart.measure},
            {"error", error_label(chart, "share")},
            {"unit", chart.unit.empty() ? "1" : chart.unit},
            {"cost", label(chart.cost)},
            {"against", chart.against.empty() ? Json() : Json(chart.against)},
            {"references", chart.references},
            {"machines", chart.machines},
            {"fixed", chart.fixed},
            {"series", Json::array()}};
  for (const ChartSeries& series : chart.series) {
    Json one{{"name", series.name}, {"method", series.method}, {"order", series.order}};
    for (const ChartPoint& point : series.points) one["runs"].add(point_json(point));
    json["series"].add(std::move(one));
  }
  return json.dump(2) + "\n";
}

std::string error_label(const Chart& chart, std::string_view share) {
  const std::string unit = chart.unit.empty() ? std::string(share) : chart.unit;
  if (!chart.against.empty())
    return fmt::format("{}, difference from {}, {}", chart.measure, chart.against, unit);
  if (!chart.unit.empty() || !chart.relative) return fmt::format("{}, {}", chart.measure, unit);
  return fmt::format("error of {}, {} of the reference", chart.measure, share);
}

std::vector<std::string> footnotes(const Chart& chart) {
  const auto all = spacings(chart);
  std::string what = fmt::format("Scene {}, particles {}", chart.scene, shown_spacing(*all.begin()));
  what += all.size() > 1
              ? fmt::format(" to {} apart, each line from coarse to fine", shown_spacing(*all.rbegin()))
              : " apart";
  if (!chart.fixed.empty()) what += "; all with " + join(chart.fixed);
  if (chart.several_contacts) what += "; contact laws differ";
  if (chart.left_out > 0) what += fmt::format("; without {} runs that are not stable", chart.left_out);
  if (has_zero(chart)) what += "; points on an axis: an error of 0 or an unknown cost";
  std::vector<std::string> notes{what};
  const std::string references = join(chart.references, "; ");
  if (!chart.against.empty())
    notes.push_back(fmt::format("Compared with {}, which is not an independent reference{}", chart.against,
                                references.empty() ? "" : "; independent references: " + references));
  else if (!references.empty())
    notes.push_back("Reference: " + references);
  std::vector<std::string> without;
  for (const ChartSeries& series : chart.series) {
    std::vector<std::string> reasons;
    for (const ChartPoint& point : series.points)
      if (const std::string why = without_error(point);
          !why.empty() && std::ranges::find(reasons, why) == reasons.end())
        reasons.push_back(why);
    if (!reasons.empty()) without.push_back(fmt::format("{} ({})", series.name, join(reasons, "; ")));
  }
  constexpr std::size_t longest = 130;
  std::size_t more = 0;
  for (; without.size() > 1 && join(without).size() > longest; ++more) without.pop_back();
  if (!without.empty())
    notes.push_back(fmt::format("Some or all runs have no error: {}{}", join(without),
                                more == 0 ? "" : fmt::format(" and {} more", more)));
  if (is_time(chart.cost))
    notes.push_back(fmt::format(
        "Time: {}{}", join(chart.machines, "; "),
        chart.other_load < busy_load
            ? ""
            : fmt::format("; the machine was busy: others used up to {} cores", brief(chart.other_load))));
  return notes;
}

}  // namespace taut::cli
