#pragma once

#include <vector>

#include "engine/core/tensor.hpp"
#include "engine/methods/term_info.hpp"

namespace taut::inline TAUT_ISA {

/// What turns: about the axis beside the plane in 2D, about any axis in 3D.
template <int Dim>
struct Turning;
template <>
struct Turning<2> {
  double torque = 0, inertia = 0;

  void add(double V, const Vec<double, 2>& z, const Vec<double, 2>& a) {
    torque += V * (z[0] * a[1] - z[1] * a[0]);
    inertia += V * dot(z, z);
  }
  double rate() const { return torque / inertia; }
  static Vec<double, 2> times(double lambda, const Vec<double, 2>& z) {
    return {-lambda * z[1], lambda * z[0]};
  }
};
template <>
struct Turning<3> {
  Vec<double, 3> torque{};
  Sym<double, 3> inertia{};

  void add(double V, const Vec<double, 3>& z, const Vec<double, 3>& a) {
    torque += V * cross(z, a);
    add_outer(inertia, -V, z);
    for (int k = 0; k < 3; ++k) inertia(k, k) += V * dot(z, z);
  }
  Vec<double, 3> rate() const { return inverse(inertia) * torque; }  // 0 for particles on one line
  static Vec<double, 3> times(const Vec<double, 3>& lambda, const Vec<double, 3>& z) {
    return cross(lambda, z);
  }
};

/// The accelerations nearest to `a`, in the mean square over the volume, that change neither the linear nor
/// the angular momentum of a body:  Σ V a = 0,  Σ V Z × a = 0.                          [Lee2016] Eq. 45–48
/// a_i − ω × (Z_i − Z̄) − ā, with Z̄ and ā means over the volume and ω the torque over the inertia about Z̄: the
/// paper's system (Eq. 48) with its two unknowns apart. One body is the particles first … last − 1, of one
/// density. The sums are taken in the order of the particles, so that they do not depend on the number of
/// threads. With a share below 1 the accelerations go that part of the way.
template <int Dim>
void project_on_momenta(std::vector<Vec<double, Dim>>& a, const std::vector<Vec<double, Dim>>& Z,
                        const std::vector<double>& V, int first, int last, double share = 1) {
  double volume = 0;
  Vec<double, Dim> mean_a{}, mean_Z{};
  for (int i = first; i < last; ++i) {
    volume += V[i];
    mean_a += V[i] * a[i];
    mean_Z += V[i] * Z[i];
  }
  mean_a = (1 / volume) * mean_a;
  mean_Z = (1 / volume) * mean_Z;
  Turning<Dim> turning;  // torque and inertia over the density
  for (int i = first; i < last; ++i) turning.add(V[i], Z[i] - mean_Z, a[i]);
  const auto omega = turning.rate();
  for (int i = first; i < last; ++i) a[i] -= share * (Turning<Dim>::times(omega, Z[i] - mean_Z) + mean_a);
}

inline constexpr TermInfo projection_info{
    "projection", "forces and D(v) nearest to those with Σ V a = 0, Σ V Z × a = 0", "[Lee2016] Eq. 45–51",
    "families/tl_mixed/momentum_projection.hpp:project_on_momenta",
    "projection: the nearest accelerations without force and torque"};

}  // namespace taut::inline TAUT_ISA
