#include "cli/study/choose.hpp"

#include <algorithm>

#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

bool accurate(const ChartPoint& point, const Wish& wish) {
  return point.stable && point.error && *point.error <= wish.error;
}

bool in_time(const ChartPoint& point, const Wish& wish) {
  return !wish.seconds || point.cost <= *wish.seconds;
}

std::string shown_error(const Chart& chart, double error) {
  return chart.unit.empty() ? percent(error) : brief(error) + " " + chart.unit;
}

std::string wish_line(const Chart& chart, const Wish& wish) {
  std::string text =
      chart.scene + ", error of " + chart.measure + " at most " + shown_error(chart, wish.error);
  if (wish.seconds) text += ", within " + brief(*wish.seconds) + " s";
  return text;
}

std::string settings_of(const ChartSeries& series, const ChartPoint& point) {
  std::string text = series.name + " at a spacing of " + brief(point.spacing) + " m";
  if (!point.cfl.empty()) text += ", cfl " + point.cfl;
  if (!point.stepping.empty()) text += ", " + point.stepping + " stepping";
  return text;
}

std::string result_of(const Chart& chart, const ChartPoint& point) {
  return "error " + shown_error(chart, *point.error) + ", " + brief(point.cost) + " s";
}

std::vector<std::string> row(const Chart& chart, const ChartSeries& series, const ChartPoint& point) {
  return {series.name,       brief(point.spacing),
          point.cfl,         point.error ? shown_error(chart, *point.error) : "-",
          brief(point.cost), point.verdict};
}

/// What was taken among its neighbours in spacing, and what other methods would cost.
std::string evidence(const Chart& chart, const std::vector<Grant>& all) {
  const std::vector<std::string> heading{"method", "spacing, m", "cfl", "error", "s", "verdict"};
  std::vector<std::vector<std::string>> own{heading}, others{heading};
  for (const ChartPoint& point : all.front().series->points)
    own.push_back(row(chart, *all.front().series, point));
  for (const Grant& grant : all) others.push_back(row(chart, *grant.series, *grant.point));
  std::string text = "\nAll its runs:\n" + in_columns(own);
  if (all.size() > 1)
    text += "\nThe cheapest run of each method that grants the wish:\n" + in_columns(others);
  return text + "\nReference: " + join(chart.references, "; ") + "\nTime: " + join(chart.machines, "; ") +
         "\n";
}

/// The stable run in time with the least error.
std::string nearest_run(const Chart& chart, const Wish& wish) {
  const ChartSeries* series = nullptr;
  const ChartPoint* nearest = nullptr;
  for (const ChartSeries& s : chart.series)
    for (const ChartPoint& point : s.points)
      if (point.stable && point.error && in_time(point, wish) &&
          (!nearest || *point.error < *nearest->error)) {
        series = &s;
        nearest = &point;
      }
  if (!nearest)
    return "No stable run with a measured error is there" + std::string(wish.seconds ? " in that time" : "") +
           ".\n";
  std::string text = "The least error of a stable run";
  if (wish.seconds) text += " in that time";
  text += ": " + settings_of(*series, *nearest) + ", " + result_of(chart, *nearest) + ".\n";
  if (*nearest->error <= wish.error) text += "Finer runs of the same method contradict it.\n";
  return text;
}

}  // namespace

std::vector<Grant> grants(const Chart& chart, const Wish& wish) {
  std::vector<Grant> all;
  for (const ChartSeries& series : chart.series) {
    std::optional<Grant> cheapest;
    int finer = 0;
    for (auto point = series.points.rbegin(); point != series.points.rend() && accurate(*point, wish);
         ++point) {
      if (in_time(*point, wish) && (!cheapest || point->cost < cheapest->point->cost))
        cheapest = Grant{&series, &*point, finer};
      ++finer;
    }
    if (cheapest) all.push_back(*cheapest);
  }
  std::ranges::stable_sort(all, {}, [](const Grant& grant) { return grant.point->cost; });
  return all;
}

std::string advice(const Chart& chart, const Wish& wish) {
  const std::vector<Grant> all = grants(chart, wish);
  std::string text = wish_line(chart, wish) + ":\n\n";
  if (all.empty())
    return text + "The results do not reach that far. " + nearest_run(chart, wish) +
           "Sweep finer spacings or other methods for an answer.\n";
  const Grant& best = all.front();
  text += "  take  " + settings_of(*best.series, *best.point) + ": " + result_of(chart, *best.point) + "\n";
  text += "  run   " + best.point->folder + "\n";
  text += best.finer == 0 ? "\nNo finer run confirms it: its error may be small by luck.\n"
                          : "\nFiner runs that confirm it: " + std::to_string(best.finer) + ".\n";
  return text + evidence(chart, all);
}

}  // namespace taut::cli
