#include "engine/scene/shapes/box.hpp"

#include <algorithm>

#include "engine/core/index.hpp"

namespace taut {

long Box::cells(std::size_t axis, double dp) const {
  return std::max(1L, std::lround((high[axis] - low[axis]) / dp));
}

bool Box::holds(const Point& x, int dim, double tolerance) const {
  for (std::size_t k = 0; k < as_index(dim); ++k)
    if (x[k] < low[k] - tolerance || x[k] > high[k] + tolerance) return false;
  return true;
}

double Box::measure(int dim) const {
  double product = 1;
  for (std::size_t k = 0; k < as_index(dim); ++k) product *= std::max(0.0, high[k] - low[k]);
  return product;
}

double Box::extent_to_divide(int dim) const {
  double least = high[0] - low[0];
  for (std::size_t k = 1; k < as_index(dim); ++k) least = std::min(least, high[k] - low[k]);
  return least;
}

std::vector<Chain> Box::outline(int dim, double dp) const {
  if (dim != 2) return {};
  const Point corners[] = {low, {high[0], low[1], 0}, high, {low[0], high[1], 0}};
  Chain chain;
  for (std::size_t side = 0; side < 4; ++side) {
    const Point &from = corners[side], &to = corners[(side + 1) % 4];
    const long n = std::max(1L, std::lround(distance_between(from, to, dim) / dp));
    for (long k = 0; k < n; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(n);
      chain.push_back({from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]), 0});
    }
  }
  return {chain};
}

}  // namespace taut
