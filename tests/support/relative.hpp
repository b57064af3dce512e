#pragma once

#include <doctest/doctest.h>

namespace taut::test {

/// Equal within `epsilon` of the value, 1.2e-5 unless it says otherwise, or of `scale` more where a value may be 0.
/// That of doctest allows epsilon · (1 + |value|): anything, where values are metres or seconds of small things.
class Approx : public doctest::Approx {
 public:
  explicit Approx(double value) : doctest::Approx(value) { scale(1e-290); }  // 0 is 0
};

inline doctest::Approx relative(double value, double epsilon = 1e-9) {
  return Approx(value).epsilon(epsilon);
}

}  // namespace taut::test
