#pragma once

#include "engine/core/pack.hpp"

namespace taut {

/// Adds many numbers with the error of one addition, so that a momentum that is conserved to round-off can be
/// seen to be: what each addition loses (Knuth 1969) is added up too. Four sums at once, one a lane.
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
