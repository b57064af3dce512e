#pragma once

#include <doctest/doctest.h>

namespace taut::test {

/// Relative comparison, by default within 1.2e-5. doctest's own tolerance, epsilon · (1 + |value|), accepts any two
/// small values.
class Approx : public doctest::Approx {
 public:
  explicit Approx(double value) : doctest::Approx(value) { scale(1e-290); }
};

inline doctest::Approx relative(double value, double epsilon = 1e-9) {
  return Approx(value).epsilon(epsilon);
}

}  // namespace taut::test
