#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/chart.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

struct ChoiceLimits {
  double error = 0;               // maximum, as a share or in the chart's unit
  std::optional<double> seconds;  // maximum solving time
};

/// All finer runs of the series are stable, too, and have an error.
struct Offer {
  const ChartSeries* series;
  const ChartPoint* point;
  double error = 0;  // greatest of this and the finer runs
  int finer = 0;
};

/// The cheapest run of each series within the limits, sorted by cost.
std::vector<Offer> suitable_offers(const Chart& chart, const ChoiceLimits& limits);
/// Sorted by cost.
std::vector<Offer> pareto_front(const Chart& chart, std::optional<double> seconds);

/// The cheapest run with its evidence, or the reason why there is none.
std::string advice(const Chart& chart, const ChoiceLimits& limits);
std::string price_list(const Chart& chart, std::optional<double> seconds);
Json to_json(const std::vector<Offer>& offers);

}  // namespace taut::cli
