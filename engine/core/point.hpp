#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace taut {

/// Point or vector; unused components are 0.
using Point = std::array<double, 3>;

inline double distance_between(const Point& a, const Point& b, int dim) {
  double squared = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k) squared += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(squared);
}

}  // namespace taut
