#pragma once

#include <cmath>

namespace taut {

/// Adds many numbers with the error of one addition (Neumaier 1974), so that a momentum that is conserved to
/// round-off can be seen to be.
class CompensatedSum {
 public:
  void operator+=(double term) {
    const double next = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

}  // namespace taut
