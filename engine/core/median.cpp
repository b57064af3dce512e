#include "engine/core/median.hpp"

#include <algorithm>
#include <cstddef>

namespace taut {

double median(std::span<double> some) {
  const auto half = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
  std::nth_element(some.begin(), half, some.end());
  return *half;
}

}  // namespace taut
