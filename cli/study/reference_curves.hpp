#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace taut::cli {

/// Reference of a probe over time, SI units.
struct ReferenceCurve {
  std::string column;  // of history.csv
  std::string name;    // "finite elements"
  std::vector<double> t, values;
};

/// A curve for each probe that a measure compares with a table, or with an exact solution, which is evaluated at
/// `times`. Empty if the scene has no reference for the material law.
std::vector<ReferenceCurve> reference_curves(const Scene& scene, const std::string& law,
                                             std::span<const double> times);
inline constexpr int solution_samples = 400;  // usual number of times

}  // namespace taut::cli
