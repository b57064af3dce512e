#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/study/stored_results.hpp"

namespace taut::cli {

enum class Cost {
  cpu,             // CPU seconds of the solver, which other processes hardly change
  wall,            // seconds of solving
  particle_steps,  // particles × steps, equal on all machines
};
inline bool is_time(Cost cost) { return cost != Cost::particle_steps; }
std::vector<std::string> cost_names();
/// Throws UsageError with the nearest names.
Cost find_cost(const std::string& name);
std::string label(Cost cost);

struct ChartRequest {
  std::string measure;                 // empty: default
  Cost cost = Cost::cpu;               // wall if a run has no CPU seconds
  std::vector<std::string> methods{};  // empty: all
  std::string against{};               // method whose finest run replaces references
  bool stable_only = false;            // without the other runs
  std::optional<StoredRun> run{};      // run that replaces references, instead of a method

  bool replaces_references() const { return run || !against.empty(); }
};

struct ChartPoint {
  double spacing = 0;           // m
  std::optional<double> error;  // none: no value or no reference
  bool measured = true;         // has a value, with or without an error
  double cost = 0;              // s or particle-steps; 0: unknown
  std::string verdict{}, folder{};
  std::string cfl{}, stepping{};  // empty: unknown
  bool stable = true;
};

/// Runs of one method that differ only in spacing, from coarse to fine.
struct ChartSeries {
  std::string name, method;
  std::vector<ChartPoint> points;
  std::optional<double> order;  // of convergence
};

struct Chart {
  std::string title, scene, measure;
  std::string unit;      // of the errors; empty: a share
  bool relative = true;  // errors relative to the reference
  Cost cost = Cost::cpu;
  bool lacks_cpu = false;  // CPU seconds were requested, but a run has none
  double other_load = 0;   // greatest number of cores that others used during a run
  int dim = 2;
  std::string against;             // "oenog at 0.5 mm"; empty: the references
  std::vector<std::string> fixed;  // "single stepping", "until = 0.3"
  std::vector<ChartSeries> series;
  std::vector<std::string> references;  // "finite elements (oenog, tl)"
  std::vector<std::string> machines;    // "AMD EPYC, 1 thread"
  int without_result = 0;               // unfinished
  int left_out = 0;                     // not stable, if only stable ones are requested
  std::string kind{};                   // of the measure: "rmse"
};

/// From this number of cores used by others, costs are doubtful.
inline constexpr double busy_load = 0.5;

/// Reason of a missing error: "no reference", "no value" or the verdict; empty if the point has an error.
std::string without_error(const ChartPoint& point);

/// "1.2 %" or "3 mm".
std::string shown_error(const Chart& chart, double error);

/// Least-squares slope of log error over log spacing of the stable runs; nullopt for fewer than two spacings.
std::optional<double> convergence_order(const std::vector<ChartPoint>& points);

/// The default measure is the one with errors in most runs; at a tie, the scene's first. Times (`*_time`) and errors
/// with a unit come last, because they hardly depend on accuracy or are not comparable. Of repeated runs, the
/// cheapest counts. Runs that serve as reference have no point. Throws UsageError for an unknown measure, with the
/// nearest names, and for a measure without any error.
Chart make_chart(const StoredResults& results, const ChartRequest& request);

}  // namespace taut::cli
