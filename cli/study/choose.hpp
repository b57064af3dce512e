#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/chart.hpp"
#include "cli/text/json.hpp"

namespace taut::cli {

/// What somebody asks of a run.
struct Wish {
  double error = 0;               // at most; a share, or in the chart's unit
  std::optional<double> seconds;  // of solving, at most
};

/// A stable run with what the finer runs of its series say of it: where one of them fails, its own error was
/// met by chance, and it is no offer.
struct Offer {
  const ChartSeries* series;
  const ChartPoint* point;
  double error = 0;  // the greatest of its own and theirs
  int finer = 0;     // their number
};

/// From each series the cheapest offer that grants the wish, the cheapest one first.
std::vector<Offer> grants(const Chart& chart, const Wish& wish);
/// The offers that no other one beats in both error and cost, the cheapest one first: what is taken for one
/// wish or another.
std::vector<Offer> front(const Chart& chart, std::optional<double> seconds);

/// For people: what to take, with the evidence; or that no run does, and how near the nearest comes.
std::string advice(const Chart& chart, const Wish& wish);
/// For people: what each accuracy costs.
std::string price_list(const Chart& chart, std::optional<double> seconds);
/// One object per offer.
Json to_json(const std::vector<Offer>& offers);

}  // namespace taut::cli
