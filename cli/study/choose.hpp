#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/chart.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

struct Wish {
  double error = 0;               // a share or in the chart's unit
  std::optional<double> seconds;  // of solving
};

/// A stable run. If a finer run fails, its accuracy is accidental, and it is no offer.
struct Offer {
  const ChartSeries* series;
  const ChartPoint* point;
  double error = 0;  // greatest, also of finer runs
  int finer = 0;     // number of finer runs
};

/// Cheapest suitable run of each series, cheapest first.
std::vector<Offer> grants(const Chart& chart, const Wish& wish);
/// Runs not beaten in both error and cost, cheapest first.
std::vector<Offer> front(const Chart& chart, std::optional<double> seconds);

std::string advice(const Chart& chart, const Wish& wish);
std::string price_list(const Chart& chart, std::optional<double> seconds);
Json to_json(const std::vector<Offer>& offers);

}  // namespace taut::cli
