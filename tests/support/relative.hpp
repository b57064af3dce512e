#pragma once

#include <doctest/doctest.h>

namespace taut::test {

/// Compares relative to the value, by default within 1.2e-5, plus `scale` where a value can be 0. doctest's Approx
/// allows epsilon · (1 + |value|), which accepts any two small values in SI units.
class Approx : public doctest::Approx {
 public:
  explicit Approx(double value) : doctest::Approx(value) { scale(1e-290); }
};

inline doctest::Approx relative(double value, double epsilon = 1e-9) {
  return Approx(value).epsilon(epsilon);
}

}  // namespace taut::test
