#include "cli/study/chart.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct CostName {
  Cost cost;
  std::string_view name, label;
};
constexpr CostName costs[] = {
    {Cost::seconds, "seconds", "time to solve, s"},
    {Cost::particle_steps, "steps", "particles × steps"},
};

std::string column(const std::string& measure, std::string_view what) {
  return ("measures." + measure + ".").append(what);
}

bool has_error(const StoredRun& run, const std::string& measure) {
  return run.has_result() && run.number(column(measure, "error")).has_value();
}

std::vector<std::string> charted_measures(const StoredResults& results) {
  std::vector<std::string> names = results.measures();
  std::erase_if(names, [&](const std::string& measure) {
    return std::ranges::none_of(results.runs, [&](const StoredRun& run) { return has_error(run, measure); });
  });
  return names;
}

/// The unit of its errors, empty: a share of the reference or of a length.
std::string error_unit(const StoredRun& run, const std::string& measure) {
  const bool relative = run.number(column(measure, "reference")).value_or(0) != 0;
  const std::string unit = run.text(column(measure, "unit"));
  return relative || unit == "1" ? "" : unit;
}

std::string default_measure(const StoredResults& results, const std::vector<std::string>& charted) {
  const auto rank = [&](const std::string& measure) {
    const auto with_error = [&](const StoredRun& run) { return has_error(run, measure); };
    const StoredRun& any = *std::ranges::find_if(results.runs, with_error);
    const bool last = measure.ends_with("_time") || !error_unit(any, measure).empty();
    return std::pair(last, -std::ranges::count_if(results.runs, with_error));
  };
  return *std::ranges::min_element(charted, {}, rank);
}

std::string chosen_measure(const StoredResults& results, const std::string& wanted) {
  const std::vector<std::string> all = results.measures(), charted = charted_measures(results);
  if (!wanted.empty() && std::ranges::find(all, wanted) == all.end())
    throw UsageError(unknown_name("measure of " + results.scene, wanted, all));
  if (charted.empty())
    throw UsageError(
        "no measure in the results of " + results.scene +
        " has an error: its references do not hold for these parameters, or the runs were too short");
  if (wanted.empty()) return default_measure(results, charted);
  if (std::ranges::find(charted, wanted) != charted.end()) return wanted;
  const bool referenced = std::ranges::any_of(results.runs, [&](const StoredRun& run) {
    return run.number(column(wanted, "reference")).has_value();
  });
  throw UsageError(std::string("no run has an error of ") + wanted + ": " +
                   (referenced ? "all ended before it could be measured"
                               : "the scene has no reference for it with these parameters") +
                   "; measures with an error: " + join(charted));
}

ChartPoint point_of(const StoredRun& run, const std::string& measure, Cost cost) {
  ChartPoint point;
  point.spacing = run.number("spacing").value_or(0);
  point.error = run.number(column(measure, "error"));
  if (point.error && !(*point.error > 0)) point.error.reset();  // it has no logarithm
  const double steps = run.number("particles").value_or(0) * run.number("steps").value_or(0);
  point.cost = cost == Cost::seconds ? run.number("seconds.solve").value_or(0) : steps;
  point.verdict = run.text("verdict");
  point.folder = run.folder();
  point.cfl = run.text("cfl");
  point.stepping = run.text("stepping");
  point.stable = run.is_stable();
  return point;
}

void add_point(ChartSeries& series, const ChartPoint& point) {
  const auto same = std::ranges::find(series.points, point.spacing, &ChartPoint::spacing);
  if (same == series.points.end())
    series.points.push_back(point);
  else if (point.cost < same->cost)
    *same = point;
}

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
}

std::string machine_of(const StoredRun& run) {
  const std::string machine = run.text("machine"), threads = run.text("threads");
  return (machine.empty() ? "a machine that the results do not name" : machine) + ", " + threads +
         (threads == "1" ? " thread" : " threads");
}

/// Each reference with the methods that it is for, where there are several, and few methods.
std::vector<std::string> references_of(const StoredResults& results, const std::string& measure) {
  std::vector<std::pair<std::string, std::vector<std::string>>> methods;
  for (const StoredRun& run : results.runs) {
    const std::string name = run.text(column(measure, "reference_name"));
    if (name.empty()) continue;
    auto found = std::ranges::find(methods, name, [](const auto& m) { return m.first; });
    if (found == methods.end()) found = methods.insert(methods.end(), {name, {}});
    add_once(found->second, run.method());
  }
  constexpr std::size_t few = 7;  // methods, on one line below a chart
  std::size_t count = 0;
  for (const auto& [name, of] : methods) count += of.size();
  std::vector<std::string> all;
  for (const auto& [name, of] : methods)
    all.push_back(methods.size() == 1 || count > few ? name : name + " (" + join(of) + ")");
  return all;
}

/// What the errors of a measure are shares of, or their unit.
void describe_errors(Chart& chart, const StoredRun& run) {
  chart.relative = run.number(column(chart.measure, "reference")).value_or(0) != 0;
  chart.unit = error_unit(run, chart.measure);
  chart.dim = static_cast<int>(run.number("dim").value_or(2));
}

}  // namespace

std::vector<std::string> cost_names() {
  std::vector<std::string> names;
  for (const CostName& cost : costs) names.emplace_back(cost.name);
  return names;
}

Cost find_cost(const std::string& name) {
  const auto* found = std::ranges::find(costs, name, &CostName::name);
  if (found != std::end(costs)) return found->cost;
  throw UsageError(unknown_name("cost", name, cost_names()));
}

std::string label(Cost cost) { return std::string(std::ranges::find(costs, cost, &CostName::cost)->label); }

std::string shown_error(const Chart& chart, double error) {
  return chart.unit.empty() ? percent(error) : brief(error) + " " + chart.unit;
}

std::optional<double> convergence_order(const std::vector<ChartPoint>& points) {
  double n = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
  for (const ChartPoint& point : points) {
    if (!point.stable || !point.error) continue;
    const double x = std::log(point.spacing), y = std::log(*point.error);
    n += 1;
    x_sum += x;
    y_sum += y;
    xx_sum += x * x;
    xy_sum += x * y;
  }
  const double spread = n * xx_sum - x_sum * x_sum;  // n² times the variance: all spacings differ
  if (n < 2) return std::nullopt;
  return (n * xy_sum - x_sum * y_sum) / spread;
}

Chart make_chart(const StoredResults& results, const ChartRequest& request) {
  Chart chart;
  chart.title = results.title;
  chart.scene = results.scene;
  chart.measure = chosen_measure(results, request.measure);
  chart.cost = request.cost;
  const std::vector<std::string> columns = distinguishing_columns(results.runs, "spacing");
  for (const StoredRun& run : results.runs) {
    if (!run.has_result()) {
      ++chart.without_result;
      continue;
    }
    const std::string name = series_name(run, columns);
    auto series = std::ranges::find(chart.series, name, &ChartSeries::name);
    if (series == chart.series.end())
      series = chart.series.insert(series, ChartSeries{.name = name, .points = {}, .order = {}});
    add_point(*series, point_of(run, chart.measure, chart.cost));
    if (has_error(run, chart.measure)) describe_errors(chart, run);
    add_once(chart.machines, machine_of(run));
  }
  for (ChartSeries& series : chart.series) {
    std::ranges::sort(series.points, std::greater(), &ChartPoint::spacing);
    series.order = convergence_order(series.points);
  }
  chart.references = references_of(results, chart.measure);
  return chart;
}

std::string orders_table(const Chart& chart) {
  std::vector<std::vector<std::string>> rows{{"method", "order", "runs", "finest, m", "its error",
                                              chart.cost == Cost::seconds ? "its s" : "its steps",
                                              "not stable"}};
  for (const ChartSeries& series : chart.series) {
    const ChartPoint& finest = series.points.back();
    const auto unstable = std::ranges::count(series.points, false, &ChartPoint::stable);
    rows.push_back({series.name, series.order ? brief(*series.order) : "-",
                    std::to_string(series.points.size()), brief(finest.spacing),
                    finest.error ? shown_error(chart, *finest.error) : "-", brief(finest.cost),
                    unstable == 0 ? "" : std::to_string(unstable)});
  }
  return in_columns(rows);
}

}  // namespace taut::cli
