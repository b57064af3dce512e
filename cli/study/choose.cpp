#include "cli/study/choose.hpp"

#include <algorithm>
#include <limits>

#include <fmt/core.h>

#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

bool in_time(const ChartPoint& point, std::optional<double> seconds) {
  return !seconds || point.ranked_cost() <= *seconds;
}

std::vector<Offer> offers(const ChartSeries& series) {
  std::vector<Offer> all;
  double worst = 0;
  for (auto point = series.points.rbegin(); point != series.points.rend(); ++point) {
    if (!point->stable || !point->error) break;
    worst = std::max(worst, *point->error);
    all.push_back({&series, &*point, worst, static_cast<int>(all.size())});
  }
  return all;
}

std::vector<Offer> cheapest_first(std::vector<Offer> all) {
  std::ranges::stable_sort(all, {}, [](const Offer& offer) { return offer.point->ranked_cost(); });
  return all;
}

std::string limits_line(const Chart& chart, const ChoiceLimits& limits) {
  std::string text =
      fmt::format("{}, error of {} at most {}", chart.scene, chart.measure, shown_error(chart, limits.error));
  if (limits.seconds) text += fmt::format(", within {} s", brief(*limits.seconds));
  return text;
}

std::string settings_of(const ChartSeries& series, const ChartPoint& point) {
  std::string text = fmt::format("{} at a spacing of {} m", series.name, brief(point.spacing));
  if (!point.cfl.empty()) text += ", cfl " + point.cfl;
  if (!point.stepping.empty()) text += fmt::format(", {} stepping", point.stepping);
  return text;
}

std::string result_of(const Chart& chart, const ChartPoint& point) {
  return fmt::format("error {}, {} s", shown_error(chart, *point.error), shown_cost(point.cost));
}

std::vector<std::string> choice_row(const Chart& chart, const ChartSeries& series, const ChartPoint& point) {
  return {series.name,
          brief(point.spacing),
          point.cfl,
          point.error ? shown_error(chart, *point.error) : "-",
          shown_cost(point.cost),
          point.verdict};
}

std::string sources(const Chart& chart) {
  const std::string reference = chart.against.empty() ? join(chart.references, "; ") : chart.against;
  return fmt::format("\nReference: {}\nTime: {}\n", reference, join(chart.machines, "; "));
}

std::string evidence(const Chart& chart, const std::vector<Offer>& all) {
  const std::vector<std::string> heading{"method", "spacing, m", "cfl", "error", "s", "verdict"};
  std::vector<std::vector<std::string>> own{heading}, others{heading};
  for (const ChartPoint& point : all.front().series->points)
    own.push_back(choice_row(chart, *all.front().series, point));
  for (const Offer& offer : all) others.push_back(choice_row(chart, *offer.series, *offer.point));
  std::string text = "\nAll runs of this method:\n" + in_columns(own);
  if (all.size() > 1)
    text += "\nThe cheapest run of each method that is accurate enough:\n" + in_columns(others);
  return text + sources(chart);
}

/// Reason why no run within the time limit is offered for any error.
std::string nothing_offered(const Chart& chart, std::optional<double> seconds) {
  bool measured = false, quick = false;
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points) {
      if (!point.stable || !point.error) continue;
      measured = true;
      quick |= in_time(point, seconds);
    }
  const char* const limit = seconds && measured ? " in this time" : "";
  return quick ? fmt::format(
                     "Each stable run{} has a finer run of its method that is unstable or has no error.\n",
                     limit)
               : fmt::format("There is no stable run with a measured error{}.\n", limit);
}

/// Smallest error of a stable run within the time limit, and the cheapest suitable run beyond it.
std::string refusal(const Chart& chart, const ChoiceLimits& limits) {
  const ChartSeries* series = nullptr;
  const ChartPoint* nearest = nullptr;
  for (const ChartSeries& s : chart.series)
    for (const ChartPoint& point : s.points)
      if (point.stable && point.error && in_time(point, limits.seconds) &&
          (!nearest || *point.error < *nearest->error)) {
        series = &s;
        nearest = &point;
      }
  const char* const limit = limits.seconds ? " in this time" : "";
  std::string text;
  if (!nearest) {
    text = nothing_offered(chart, limits.seconds);
  } else {
    if (*nearest->error > limits.error) text = fmt::format("No run{} is accurate enough. ", limit);
    text += fmt::format("The smallest error of a stable run{}: {}, {}.\n", limit,
                        settings_of(*series, *nearest), result_of(chart, *nearest));
    if (*nearest->error <= limits.error) text += "Finer runs of the same method do not confirm this error.\n";
  }
  const std::vector<Offer> slower = suitable_offers(chart, {limits.error, std::nullopt});
  if (slower.empty() || !(slower.front().point->cost > 0))
    return text + "Sweep other spacings or other methods.\n";
  return text + fmt::format(
                    "The cheapest run that is accurate enough takes longer: {}, {}.\n"
                    "Allow more time, or sweep other methods.\n",
                    settings_of(*slower.front().series, *slower.front().point),
                    result_of(chart, *slower.front().point));
}

}  // namespace

std::vector<Offer> suitable_offers(const Chart& chart, const ChoiceLimits& limits) {
  std::vector<Offer> all;
  for (const ChartSeries& series : chart.series) {
    std::vector<Offer> granted = cheapest_first(offers(series));
    std::erase_if(granted, [&](const Offer& offer) {
      return offer.error > limits.error || !in_time(*offer.point, limits.seconds);
    });
    if (!granted.empty()) all.push_back(granted.front());
  }
  return cheapest_first(all);
}

std::vector<Offer> pareto_front(const Chart& chart, std::optional<double> seconds) {
  std::vector<Offer> all;
  for (const ChartSeries& series : chart.series)
    for (const Offer& offer : offers(series))
      if (in_time(*offer.point, seconds)) all.push_back(offer);
  double least = std::numeric_limits<double>::infinity();
  std::vector<Offer> best;
  for (const Offer& offer : cheapest_first(all))
    if (offer.error < least) {
      least = offer.error;
      best.push_back(offer);
    }
  return best;
}

std::string advice(const Chart& chart, const ChoiceLimits& limits) {
  const std::vector<Offer> all = suitable_offers(chart, limits);
  std::string text = limits_line(chart, limits) + ":\n\n";
  if (all.empty()) return text + refusal(chart, limits);
  const Offer& best = all.front();
  text += fmt::format("  take  {}: {}\n  run   {}\n", settings_of(*best.series, *best.point),
                      result_of(chart, *best.point), best.point->folder);
  text += best.finer == 0 ? "\nNo finer run confirms this error; it may be small by chance.\n"
                          : fmt::format("\nFiner runs that confirm this error: {}.\n", best.finer);
  return text + evidence(chart, all);
}

std::string price_list(const Chart& chart, std::optional<double> seconds) {
  const std::vector<Offer> all = pareto_front(chart, seconds);
  std::string text = fmt::format("{}, cost of an error of {}{}:\n\n", chart.scene, chart.measure,
                                 seconds ? fmt::format(", within {} s", brief(*seconds)) : "");
  if (all.empty()) return text + nothing_offered(chart, seconds);
  std::vector<std::vector<std::string>> rows{
      {"error up to", "s", "method", "spacing, m", "cfl", "finer runs"}};
  for (const Offer& offer : all)
    rows.push_back({shown_error(chart, offer.error), shown_cost(offer.point->cost), offer.series->name,
                    brief(offer.point->spacing), offer.point->cfl, std::to_string(offer.finer)});
  return fmt::format(
      "{}{}\n"
      "Each row is the cheapest stable run with this error. "
      "All finer runs of its method have at most this error.\n{}",
      text, in_columns(rows), sources(chart));
}

Json to_json(const std::vector<Offer>& offers) {
  Json all = Json::array();
  for (const Offer& offer : offers) {
    const ChartPoint& point = *offer.point;
    const auto optional = [](const std::string& text) {
      return text.empty() ? Json() : number_or_text(text);
    };
    all.add({{"name", offer.series->name},
             {"method", offer.series->method},
             {"spacing", point.spacing},
             {"cfl", optional(point.cfl)},
             {"stepping", optional(point.stepping)},
             {"error", point.error},
             {"error_up_to", offer.error},
             {"finer_runs", offer.finer},
             {"seconds", point.cost > 0 ? Json(point.cost) : Json()},
             {"folder", point.folder}});
  }
  return all;
}

}  // namespace taut::cli
