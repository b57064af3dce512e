#pragma once

#include <algorithm>
#include <vector>

#include "engine/core/tensor.hpp"

namespace taut {

/// Marks points inside the bounding box of another body, widened by `margin` (in m).
template <int Dim>
std::vector<char> near_other_bodies(const std::vector<Vec<double, Dim>>& x, const std::vector<int>& body,
                                    double margin) {
  std::vector<char> near(x.size());
  if (x.empty()) return near;
  struct Box {
    Vec<double, Dim> low, high;
    bool is_empty = true;
  };
  std::vector<Box> boxes(1 + *std::max_element(body.begin(), body.end()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    Box& b = boxes[body[i]];
    if (b.is_empty) b = {x[i], x[i], false};
    for (int k = 0; k < Dim; ++k)
      b.low[k] = std::min(b.low[k], x[i][k]), b.high[k] = std::max(b.high[k], x[i][k]);
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto holds = [&](const Box& box) {
      if (box.is_empty || &box == &boxes[body[i]]) return false;
      for (int k = 0; k < Dim; ++k)
        if (x[i][k] < box.low[k] - margin || x[i][k] > box.high[k] + margin) return false;
      return true;
    };
    near[i] = std::any_of(boxes.begin(), boxes.end(), holds);
  }
  return near;
}

}  // namespace taut
