#pragma once

#include <doctest/doctest.h>

namespace taut::test {

/// Equal within `epsilon` of the value. doctest's Approx alone allows epsilon · (1 + |value|): anything,
/// where values are metres or seconds of small things.
inline doctest::Approx relative(double value, double epsilon = 1e-9) {
  return doctest::Approx(value).scale(0).epsilon(epsilon);
}

}  // namespace taut::test
