#pragma once

#include <cmath>

#include "engine/core/tensor.hpp"

namespace taut::test {

struct PairedParticle {
  Vec<double, 2> x, v;
  double m, V, p;  // kg/m, m², Pa
  Sym<double, 2> s;
  double rho() const { return m / V; }
};

/// The two particles differ in every value.
inline constexpr PairedParticle first_of_pair{{0.1, 0.7}, {-3, 1}, 1.7, 0.9, 5, {2, -3, 4}};
inline constexpr PairedParticle second_of_pair{{-0.5, 0.2}, {2, 0.5}, 0.8, 1.1, -7, {-1, 6, 3}};
inline constexpr double slope_of_pair = -0.83;  // ∂W/∂r, 1/m³

struct Seen {
  Vec<double, 2> e, v_ij;
  double r, inv_r, closing_speed;

  Seen(const PairedParticle& i, const PairedParticle& j) {
    const Vec<double, 2> x_ij = i.x - j.x;
    r = std::sqrt(dot(x_ij, x_ij));
    inv_r = 1 / r;
    e = inv_r * x_ij;
    v_ij = i.v - j.v;
    closing_speed = -dot(v_ij, e);
  }
};

inline double magnitude(const Vec<double, 2>& a) { return std::sqrt(dot(a, a)); }

/// Particle j of a rigidly rotating pair.
inline PairedParticle turning_with(const PairedParticle& i, PairedParticle j, double omega) {
  const Vec<double, 2> x_ij = i.x - j.x;
  j.v = {i.v[0] + omega * x_ij[1], i.v[1] - omega * x_ij[0]};
  return j;
}

}  // namespace taut::test
