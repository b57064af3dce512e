#pragma once

#include <array>
#include <span>

#include "engine/simulation.hpp"

namespace taut {

/// The deviatoric stress of a particle as Snapshot stores it, Pa.
inline std::span<const double> deviator(const Snapshot& now, std::size_t particle) {
  const std::size_t stored = now.dim == 3 ? 6 : 4;
  return {now.s.data() + stored * particle, stored};
}

/// s:s, Pa²; a component off the diagonal stands for two. Includes s_zz in 2D.
inline double deviator_squared(const Snapshot& now, std::size_t particle) {
  static constexpr std::array<double, 4> plane = {1, 2, 1, 1};        // xx, xy, yy, zz
  static constexpr std::array<double, 6> space = {1, 2, 2, 1, 2, 1};  // xx, xy, xz, yy, yz, zz
  const double* weight = now.dim == 3 ? space.data() : plane.data();
  double sum = 0;
  for (const double s : deviator(now, particle)) sum += *weight++ * s * s;
  return sum;
}

}  // namespace taut
