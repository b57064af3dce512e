#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/measures.hpp"
#include "tests/support/relative.hpp"

namespace taut::test {

inline constexpr double pi = std::numbers::pi;

/// Steps of 1 to 3 times `shortest`.
inline std::vector<double> unequal_times(double end, double shortest) {
  std::vector<double> times = {0};
  for (int k = 0; times.back() < end; ++k) times.push_back(times.back() + shortest * (2 + std::sin(1.7 * k)));
  return times;
}

inline Series sampled(const std::vector<double>& times, const std::function<double(double)>& f) {
  Series series{times, {{}}};
  for (const double t : times) series.value[0].push_back(f(t));
  return series;
}

inline Scene scene_of(const std::string& kind) {
  Scene scene;
  scene.until = 1;
  scene.probes.resize(2);
  scene.probes[0].name = "y";
  scene.probes[1].name = "gap";
  Measure measure;
  measure.name = "number";
  measure.kind = kind;
  measure.probes = {"y"};
  measure.unit = "mm";
  scene.measures = {measure};
  return scene;
}

inline MeasureResult result(const Scene& scene, const Series& series) {
  const std::vector<MeasureResult> results = measure(scene, series, "neo_hookean");
  REQUIRE(results.size() == 1);
  return results[0];
}

inline std::optional<double> value(const std::string& kind, const Series& series) {
  return result(scene_of(kind), series).value;
}

inline std::optional<double> value(const std::string& kind, const std::vector<double>& t,
                                   const std::vector<double>& y) {
  return value(kind, Series{t, {y}});
}

inline void expect(const std::optional<double>& value, double expected, double tolerance = 1e-12) {
  REQUIRE(value);
  CHECK(*value == Approx(expected).epsilon(tolerance));
}

}  // namespace taut::test
