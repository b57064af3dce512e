#pragma once

#include <span>

#include "engine/snapshot.hpp"

namespace taut {

/// s:s, with s_zz in 2D.
template <int Dim>
double contracted(const double* s) {
  if constexpr (Dim == 3)  // xx, xy, xz, yy, yz, zz
    return s[0] * s[0] + s[3] * s[3] + s[5] * s[5] + 2 * (s[1] * s[1] + s[2] * s[2] + s[4] * s[4]);
  else  // xx, xy, yy, zz
    return s[0] * s[0] + s[2] * s[2] + s[3] * s[3] + 2 * s[1] * s[1];
}

inline std::span<const double> deviator(const Snapshot& now, std::size_t particle) {
  const std::size_t stored = now.dim == 3 ? 6 : 4;
  return {now.s.data() + stored * particle, stored};
}

inline double deviator_squared(const Snapshot& now, std::size_t particle) {
  const double* s = deviator(now, particle).data();
  return now.dim == 3 ? contracted<3>(s) : contracted<2>(s);
}

}  // namespace taut
