#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace taut::test {

/// `share`: tolerance relative to the greatest magnitude of `expected`.
inline void check_field(const std::string& field, const std::vector<double>& engine,
                        const std::vector<double>& expected, double share = 1e-10) {
  CAPTURE(field);
  REQUIRE(engine.size() == expected.size());
  double greatest = 0, difference = 0;
  for (std::size_t k = 0; k < engine.size(); ++k) {
    greatest = std::max(greatest, std::abs(expected[k]));
    difference = std::max(difference, std::abs(engine[k] - expected[k]));
  }
  CHECK(greatest > 0);
  CHECK(difference <= share * greatest);
}

template <class Places>
std::vector<double> flat(const Places& places) {
  std::vector<double> all;
  for (const auto& place : places) all.insert(all.end(), place.begin(), place.end());
  return all;
}

}  // namespace taut::test
