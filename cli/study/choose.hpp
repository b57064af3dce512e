#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/chart.hpp"

namespace taut::cli {

/// What somebody asks of a run.
struct Wish {
  double error = 0;               // at most; a share, or in the chart's unit
  std::optional<double> seconds;  // of solving, at most
};

/// The cheapest run of a series that grants a wish.
struct Grant {
  const ChartSeries* series;
  const ChartPoint* point;
  int finer = 0;  // runs that confirm it
};

/// From each series the cheapest stable run that grants the wish, the cheapest one first. One that a finer
/// run of the same series contradicts (it fails, or its error is greater than wished for) was lucky and does
/// not count.
std::vector<Grant> grants(const Chart& chart, const Wish& wish);

/// For people: what to take, with the evidence; or that no run does, and how near the nearest comes.
std::string advice(const Chart& chart, const Wish& wish);

}  // namespace taut::cli
