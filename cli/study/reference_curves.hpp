#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace taut::cli {

/// SI units.
struct ReferenceCurve {
  std::string column;
  std::string name;  // "finite elements"
  std::vector<double> t, values;
};

/// For probes compared with a table, or an exact solution evaluated at `times`. Empty without a reference for the law.
std::vector<ReferenceCurve> reference_curves(const Scene& scene, const std::string& law,
                                             std::span<const double> times);
inline constexpr int solution_samples = 400;

}  // namespace taut::cli
