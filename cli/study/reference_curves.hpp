#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace taut::cli {

/// SI units.
struct ReferenceCurve {
  std::string column;
  std::string name;               // "finite elements"
  std::vector<double> t, values;  // t along a line: distance or coordinate
  std::string time = {};          // along a line: ", t = 0.09 s"

  bool operator==(const ReferenceCurve&) const = default;
};

/// Tables of probes, or exact solutions at `times`. Empty without a reference for the law.
std::vector<ReferenceCurve> reference_curves(const Scene& scene, const std::string& law,
                                             std::span<const double> times);
inline constexpr int solution_samples = 400;

std::vector<ReferenceCurve> line_references(const Scene& scene, const std::string& law,
                                            const SampleLine& line, double t);

}  // namespace taut::cli
