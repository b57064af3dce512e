#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/study/stored_results.hpp"

namespace taut::cli {

/// What a run costs.
enum class Cost {
  seconds,         // of solving, on the machine that ran it
  particle_steps,  // particles × steps: the same on every machine
};
/// "seconds" and "steps", for people to choose from.
std::vector<std::string> cost_names();
/// Throws UsageError with the nearest names.
Cost find_cost(const std::string& name);
/// The axis.
std::string label(Cost cost);

/// What of the results a chart shows.
struct ChartRequest {
  std::string measure;  // empty: the default
  Cost cost = Cost::seconds;
  std::vector<std::string> methods{};  // empty: all
  std::string against{};  // a method whose finest run stands for a reference; empty: the scene's references
};

/// One run.
struct ChartPoint {
  double spacing = 0;           // m
  std::optional<double> error;  // as in run.json; none: the run ended before, or has nothing to compare with
  bool measured = true;         // there is a value, whether or not it has an error
  double cost = 0;              // s, or particle-steps; 0: not known
  std::string verdict{}, folder{};
  std::string cfl{}, stepping{};  // of the time step, where the results tell
  bool stable = true;
};

/// A method with one choice of everything else, from coarse to fine.
struct ChartSeries {
  std::string name, method;
  std::vector<ChartPoint> points;
  std::optional<double> order;  // of convergence
};

/// Error and cost of the runs of one scene.
struct Chart {
  std::string title, scene, measure;
  std::string unit;      // of the errors; empty: a share, of the reference or of a length
  bool relative = true;  // errors are shares of the reference
  Cost cost = Cost::seconds;
  int dim = 2;
  std::string against;                  // "oenog at 0.5 mm" in place of the references; empty: these count
  std::vector<std::string> fixed;       // what all runs had: "single stepping", "until = 0.3"
  std::vector<ChartSeries> series;      // methods in the order of the results
  std::vector<std::string> references;  // "finite elements (oenog, tl)"
  std::vector<std::string> machines;    // "AMD EPYC, 1 thread"
  int without_result = 0;               // runs that have not ended
};

/// Why a point has no error: "no reference", "no value", the verdict; empty where it has one.
std::string without_error(const ChartPoint& point);

/// "1.2 %" or "3 mm", as errors of this chart are.
std::string shown_error(const Chart& chart, double error);

/// Slope of the straight line through (log spacing, log error) of the stable runs, by least squares; none
/// with fewer than two spacings.
std::optional<double> convergence_order(const std::vector<ChartPoint>& points);

/// The default measure is the one that most runs have an error of, of equals the scene's first. When
/// something happens (touch_time) hardly depends on how well the rest is computed, and errors with a unit are
/// no share of anything: these come last. Throws UsageError for a measure that the scene has not (with the
/// nearest names), or that has no error in any run; says why. Of a run that was done twice the faster one
/// counts. Against a method's finest run, that run has no point itself.
Chart make_chart(const StoredResults& results, const ChartRequest& request);

}  // namespace taut::cli
