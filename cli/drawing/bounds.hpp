#pragma once

#include <array>
#include <span>

#include "render/renderer.hpp"

namespace taut::cli {

/// The range of values and the view that hold every frame of a sequence. What is not finite does not count.
class SequenceBounds {
 public:
  void add_values(std::span<const float> values);
  /// Positions, `dim` coordinates each; particles of diameter `diameter` (m) at most.
  void add_positions(std::span<const float> x, int dim, double diameter);

  /// Never empty; about zero when `is_signed`.
  std::array<double, 2> range(bool is_signed) const;
  /// With a margin of 5 % of the longer side.
  render::View view() const;

 private:
  struct Interval {
    double low = 1e300, high = -1e300;
    void add(double value, double margin = 0);
  };
  Interval values_, x_, y_;
};

}  // namespace taut::cli
