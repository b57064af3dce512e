#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/chart.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

struct Wish {
  double error = 0;               // at most; a share or in the chart's unit
  std::optional<double> seconds;  // of solving, at most
};

/// A stable run. If a finer run failed, its accuracy could be accidental, and it is no offer.
struct Offer {
  const ChartSeries* series;
  const ChartPoint* point;
  double error = 0;  // greatest, including finer runs
  int finer = 0;     // number of finer runs
};

/// The cheapest suitable run of each series, cheapest first.
std::vector<Offer> grants(const Chart& chart, const Wish& wish);
/// Runs that no other run beats in error and cost, cheapest first.
std::vector<Offer> front(const Chart& chart, std::optional<double> seconds);

std::string advice(const Chart& chart, const Wish& wish);
std::string price_list(const Chart& chart, std::optional<double> seconds);
Json to_json(const std::vector<Offer>& offers);

}  // namespace taut::cli
