#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/core/pack.hpp"

namespace taut {

/// x^(−1/3), odd in x, with a relative error up to 4e-16 for |x| from 1e-300 to 1e300. Bit-identical on all machines.
/// Each round reduces the residual r to O(r⁴).
inline double inverse_cube_root(double x) {
  constexpr std::uint64_t guess = 0x553ef0ff289dd796u;  // Moroz et al., Energies 14 (2021) 1058
  const double a = std::abs(x);
  double y = std::bit_cast<double>(guess - std::bit_cast<std::uint64_t>(a) / 3);
  for (int round = 0; round < 2; ++round) {
    const double r = 1 - a * y * y * y;
    y += y * r * (1.0 / 3 + r * (2.0 / 9 + r * (14.0 / 81)));
  }
  return std::copysign(y, x);
}
/// The last bits may differ from the scalar function's.
inline Pack inverse_cube_root(const Pack& x) {
  constexpr long long guess = 0x553ef0ff289dd796, third = 0x55555556;
  constexpr long long sign = std::numeric_limits<long long>::min();
  const Pack a = (Pack)((PackIndex)x & ~sign);
  const PackIndex upper = ((PackIndex)a >> 32) * third >> 32;
  Pack y = (Pack)(guess - (upper << 32));
  for (int round = 0; round < 2; ++round) {
    const Pack r = 1 - a * y * y * y;
    y += y * r * (1.0 / 3 + r * (2.0 / 9 + r * (14.0 / 81)));
  }
  return (Pack)((PackIndex)y | ((PackIndex)x & sign));
}

}  // namespace taut
