#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/chart.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// Request for a run.
struct ChoiceLimits {
  double error = 0;               // maximum; a share, or in the chart's unit
  std::optional<double> seconds;  // maximum solving time
};

/// A stable run that meets a request. If a finer run of its series does not, the accuracy is accidental, and the run
/// is no offer.
struct Offer {
  const ChartSeries* series;
  const ChartPoint* point;
  double error = 0;  // greatest, also of finer runs
  int finer = 0;     // number of finer runs
};

/// Cheapest suitable run of each series, cheapest first.
std::vector<Offer> suitable_offers(const Chart& chart, const ChoiceLimits& limits);
/// Runs not beaten in both error and cost, cheapest first.
std::vector<Offer> pareto_front(const Chart& chart, std::optional<double> seconds);

/// Text for the user: the run to take with its evidence, or how close the nearest run comes.
std::string advice(const Chart& chart, const ChoiceLimits& limits);
/// Text for the user: cost of each accuracy.
std::string price_list(const Chart& chart, std::optional<double> seconds);
Json to_json(const std::vector<Offer>& offers);

}  // namespace taut::cli
