#include "cli/study/chart.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <tuple>

#include <fmt/core.h>

#include "cli/study/chart_errors.hpp"
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
    {Cost::cpu, "cpu", "CPU time to solve, s"},
    {Cost::wall, "wall", "time to solve, s"},
    {Cost::particle_steps, "steps", "particles × steps"},
    {Cost::wall, "seconds", "time to solve, s"},  // earlier name
};

ChartPoint point_of(const StoredRun& run, const ChartErrors& errors, Cost cost) {
  ChartPoint point;
  const RunRecord& record = run.record;
  point.spacing = record.spacing;
  point.error = errors.of(run);
  point.measured = errors.measured(run);
  point.comparable = errors.comparable(run);
  point.cost = cost == Cost::cpu ? record.seconds.cpu
               : cost == Cost::wall
                   ? record.seconds.solve
                   : static_cast<double>(record.particles) * static_cast<double>(record.steps);
  if (!std::isfinite(point.cost) || point.cost < 0) point.cost = 0;
  point.verdict = run.verdict();
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
  else if (point.ranked_cost() < same->ranked_cost())
    *same = point;
}

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
}

std::string machine_of(const StoredRun& run) {
  const auto& [machine, threads] = std::tie(run.record.machine, run.record.threads);
  return fmt::format("{}, {} thread{}", machine.empty() ? "unknown machine" : machine, threads,
                     threads == 1 ? "" : "s");
}

std::vector<std::string> references_of(const StoredResults& results, const std::string& measure) {
  std::vector<std::pair<std::string, std::vector<std::string>>> methods;
  for (const StoredRun& run : results.runs) {
    const std::string& name = run.record.measure(measure).reference_name;
    if (name.empty()) continue;
    auto found = std::ranges::find(methods, name, [](const auto& m) { return m.first; });
    if (found == methods.end()) found = methods.insert(methods.end(), {name, {}});
    add_once(found->second, run.method());
  }
  constexpr std::size_t few = 7;
  std::size_t count = 0;
  for (const auto& [name, of] : methods) count += of.size();
  std::vector<std::string> all;
  for (const auto& [name, of] : methods)
    all.push_back(methods.size() == 1 || count > few ? name : fmt::format("{} ({})", name, join(of)));
  return all;
}

void describe_errors(Chart& chart, const ChartErrors& errors, const StoredRun& run) {
  chart.relative = errors.relative;
  chart.unit = errors.unit(run);
  chart.dim = run.record.dim;
}

/// Value of all runs that have one; empty if the values differ.
std::string common(const StoredResults& results, std::string_view column) {
  std::string value;
  for (const StoredRun& run : results.runs) {
    const std::string own = run.has_result() ? run.text(column) : "";
    if (own.empty() || own == value) continue;
    if (!value.empty()) return "";
    value = own;
  }
  return value;
}

std::vector<std::string> fixed_in(const StoredResults& results) {
  std::vector<std::string> all;
  const auto is_set = [&](std::string_view name) {
    return std::ranges::any_of(results.fixed, [&](const auto& set) { return set.first == name; });
  };
  if (const std::string contact = common(results, "contact"); !contact.empty() && !is_set("contact"))
    all.push_back(contact + " contact");
  if (const std::string stepping = common(results, "stepping"); !stepping.empty() && !is_set("stepping"))
    all.push_back(stepping + " stepping");
  if (const std::string cfl = common(results, "cfl"); !cfl.empty() && !is_set("cfl"))
    all.push_back("cfl " + cfl);
  if (const auto until = parsed<double>(common(results, "until")); until && !is_set("until"))
    all.push_back(fmt::format("to t = {} s", brief(*until)));
  for (const auto& [name, value] : results.fixed) all.push_back(fmt::format("{} = {}", name, value));
  return all;
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

std::string without_error(const ChartPoint& point) {
  if (point.error) return "";
  if (point.comparable && !point.measured) return point.stable ? "no value" : point.verdict;
  const std::string reason = point.comparable ? "no reference" : "no relative error: the reference is 0";
  return point.stable ? reason : fmt::format("{}, {}", reason, point.verdict);
}

std::string shown_error(const Chart& chart, double error) {
  return chart.unit.empty() ? percent(error) : fmt::format("{} {}", brief(error), chart.unit);
}

std::string shown_cost(double cost) { return cost > 0 ? brief(cost) : "-"; }

std::optional<double> convergence_order(const std::vector<ChartPoint>& points) {
  double n = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
  for (const ChartPoint& point : points) {
    if (!point.stable || !point.error || !(*point.error > 0) || !(point.spacing > 0)) continue;
    const double x = std::log(point.spacing), y = std::log(*point.error);
    n += 1;
    x_sum += x;
    y_sum += y;
    xx_sum += x * x;
    xy_sum += x * y;
  }
  const double spread = n * xx_sum - x_sum * x_sum;  // n² times the variance
  if (n < 2) return std::nullopt;
  return (n * xy_sum - x_sum * y_sum) / spread;
}

Chart make_chart(const StoredResults& given, const ChartRequest& request) {
  ChartErrors errors = chosen_errors(given, request);
  StoredResults results = given;
  keep_methods(results, request.methods);
  errors.choose_kind(results.runs);
  Chart chart;
  chart.title = results.title;
  chart.scene = results.scene;
  chart.measure = errors.measure;
  chart.lacks_cpu = request.cost == Cost::cpu && std::ranges::any_of(results.runs, [](const StoredRun& run) {
                      return run.has_result() && !(run.record.seconds.cpu > 0);
                    });
  chart.cost = chart.lacks_cpu ? Cost::wall : request.cost;
  chart.fixed = fixed_in(results);
  const std::vector<std::string> columns = distinguishing_columns(results.runs, "spacing");
  if (request.run)
    chart.against = fmt::format("the run in '{}'", request.run->folder());
  else if (errors.against.size() == 1)
    chart.against = fmt::format("{} at {}", series_name(*errors.against[0], columns),
                                shown_spacing(errors.against[0]->record.spacing));
  else if (!errors.against.empty())
    chart.against = fmt::format("{}, the finest run of each {}", request.against, join(errors.swept));
  const auto is_reference = [&](const StoredRun& run) {
    return std::ranges::any_of(errors.against, [&](const StoredRun* one) { return is_same_run(run, *one); });
  };
  std::vector<std::string> contacts;
  for (const StoredRun& run : results.runs) {
    if (!run.has_result()) ++chart.without_result;
    if (!run.has_result() || is_reference(run)) continue;
    if (request.stable_only && !run.is_stable()) {
      ++chart.left_out;
      continue;
    }
    if (chart.kind.empty()) chart.kind = run.record.measure(chart.measure).kind;
    const std::string name = series_name(run, columns);
    auto series = std::ranges::find(chart.series, name, &ChartSeries::name);
    if (series == chart.series.end())
      series = chart.series.insert(
          series, ChartSeries{.name = name, .method = run.method(), .points = {}, .order = {}});
    add_point(*series, point_of(run, errors, chart.cost));
    if (errors.of(run)) describe_errors(chart, errors, run);
    add_once(chart.machines, machine_of(run));
    if (run.record.contact) add_once(contacts, *run.record.contact);
    chart.other_load = std::max(chart.other_load, run.record.other_load.value_or(0));
  }
  if (chart.series.empty() && chart.left_out > 0)
    throw UsageError(fmt::format("none of the {} runs is stable; leave out --stable-only", chart.left_out));
  if (chart.series.empty())
    throw UsageError(fmt::format("no run is left to compare with {}; name more methods", chart.against));
  for (ChartSeries& series : chart.series) {
    std::ranges::sort(series.points, std::greater(), &ChartPoint::spacing);
    series.order = convergence_order(series.points);
    double worst = 0;  // error of finer stable runs
    for (ChartPoint& point : std::views::reverse(series.points)) {
      if (!point.stable || !point.error) continue;
      point.by_chance = *point.error < worst;
      worst = std::max(worst, *point.error);
    }
  }
  chart.several_contacts = contacts.size() > 1;
  chart.references = references_of(results, chart.measure);
  return chart;
}

}  // namespace taut::cli
