#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/study/stored_results.hpp"
#include "engine/error.hpp"

namespace taut::cli {

enum class Cost {
  cpu,             // CPU seconds of the solver
  wall,            // elapsed time, s
  particle_steps,  // equal on all machines
};
inline bool is_time(Cost cost) { return cost != Cost::particle_steps; }
std::vector<std::string> cost_names();
/// Throws UsageError.
Cost find_cost(const std::string& name);
std::string label(Cost cost);

struct ChartRequest {
  std::string measure;                 // empty: default
  Cost cost = Cost::cpu;               // becomes `wall` if a run has no CPU seconds
  std::vector<std::string> methods{};  // empty: all
  std::string against{};               // method whose finest stable run replaces the references
  bool stable_only = false;
  std::optional<StoredRun> run{};  // replaces the references

  bool replaces_references() const { return run || !against.empty(); }
};

struct ChartPoint {
  double spacing = 0;  // m
  std::optional<double> error;
  bool measured = true;    // false if it has no value, whatever the reference
  bool comparable = true;  // false for an absolute error among relative ones
  double cost = 0;         // s or particle-steps; 0: unknown
  std::string verdict{}, folder{};
  std::string cfl{}, stepping{};  // empty: unknown
  bool stable = true;
  bool by_chance = false;  // stable, but a finer stable run has a larger error

  double ranked_cost() const { return cost > 0 ? cost : std::numeric_limits<double>::infinity(); }
};

/// Points that differ only in spacing, from coarse to fine.
struct ChartSeries {
  std::string name, method;
  std::vector<ChartPoint> points;
  std::optional<double> order;
};

struct Chart {
  std::string title, scene, measure;
  std::string unit;  // empty: a share
  bool relative = true;
  Cost cost = Cost::cpu;
  bool lacks_cpu = false;  // requested, but missing in a run
  double other_load = 0;   // most cores used by other processes
  int dim = 2;
  std::string against;             // "oenog at 0.5 mm"; empty: the references
  std::vector<std::string> fixed;  // "until = 0.3"
  bool several_contacts = false;
  std::vector<ChartSeries> series;
  std::vector<std::string> references;
  std::vector<std::string> machines;
  int without_result = 0;  // unfinished
  int left_out = 0;        // not stable
  std::string kind{};      // of the measure: "rmse"
};

/// No run has an error of the requested measure.
class NoErrors : public UsageError {
 public:
  using UsageError::UsageError;
};

/// Costs are doubtful from this load on.
inline constexpr double busy_load = 0.5;

/// Reason for a missing error, such as "no reference"; empty if the point has an error.
std::string without_error(const ChartPoint& point);

/// "1.2 %" or "0.003 m".
std::string shown_error(const Chart& chart, double error);

/// "-" if unknown.
std::string shown_cost(double cost);

/// Least-squares slope of log error over log spacing of stable runs with errors > 0; nullopt for fewer than two.
std::optional<double> convergence_order(const std::vector<ChartPoint>& points);

/// The default measure has the most errors; times (`*_time`) and errors with a unit come last. Of runs with the same
/// spacing the cheapest counts. If any run has a relative error, absolute errors are left out. Throws NoErrors and
/// UsageError.
Chart make_chart(const StoredResults& results, const ChartRequest& request);

}  // namespace taut::cli
