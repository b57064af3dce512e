#pragma once

#include "engine/core/pack.hpp"

namespace taut {

/// Four compensated sums (Knuth 1969), one per lane.
class CompensatedSums {
 public:
  void operator+=(const Pack& term) {
    const Pack next = sum_ + term, taken = next - sum_;
    lost_ += (sum_ - (next - taken)) + (term - taken);
    sum_ = next;
  }
  Pack value() const { return sum_ + lost_; }

 private:
  Pack sum_{}, lost_{};
};

}  // namespace taut
