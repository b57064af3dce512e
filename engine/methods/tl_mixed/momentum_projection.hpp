#pragma once

#include "engine/core/columns.hpp"
#include "engine/term_info.hpp"

namespace taut {

template <int Dim>
struct RotationSums;
template <>
struct RotationSums<2> {
  Pack torque{}, inertia{};

  void add(const Pack& V, const Vec<Pack, 2>& z, const Vec<Pack, 2>& a) {
    torque += V * (z[0] * a[1] - z[1] * a[0]);
    inertia += V * dot(z, z);
  }
  double rate() const { return sum(torque) / sum(inertia); }
  static Vec<Pack, 2> times(double lambda, const Vec<Pack, 2>& z) { return {-lambda * z[1], lambda * z[0]}; }
};
template <>
struct RotationSums<3> {
  Vec<Pack, 3> torque{};
  Sym<Pack, 3> inertia{};

  void add(const Pack& V, const Vec<Pack, 3>& z, const Vec<Pack, 3>& a) {
    torque += V * cross(z, a);
    add_outer(inertia, Pack(-V), z);
    for (int k = 0; k < 3; ++k) inertia(k, k) += V * dot(z, z);
  }
  Vec<double, 3> rate() const { return inverse(sum(inertia)) * sum(torque); }  // 0 for collinear particles
  static Vec<Pack, 3> times(const Vec<double, 3>& lambda, const Vec<Pack, 3>& z) {
    return cross(spread(lambda), z);
  }
};

/// Volumes are 0 from `last` on.
inline Pack volumes_of_four(const double* V, int i, int last) {
  if (i + lanes <= last) return load(V + i);
  Pack four{};
  for (int lane = 0; i + lane < last; ++lane) four[lane] = V[i + lane];
  return four;
}

/// Changes `a` of a body of uniform density as little as possible (squares weighted by volume) so that total force and
/// torque vanish, [Lee2016] Eq. 45–48. `a` is padded by a pack; `share` scales the change.
template <int Dim>
void project_on_momenta(const ColumnsView<Dim>& a, const Vec<double, Dim>* Z, const double* V, int first,
                        int last, double share = 1) {
  const auto places = [&](int i) { return load_four(Z + i, last - i); };
  Pack volume{};
  Vec<Pack, Dim> sum_a{}, sum_Z{};
  for (int i = first; i < last; i += lanes) {
    const Pack V_i = volumes_of_four(V, i, last);
    volume += V_i;
    sum_a += V_i * vector_at<Dim>(a, i);
    sum_Z += V_i * places(i);
  }
  const Pack per_volume = filled<Pack>(1 / sum(volume));
  const Vec<Pack, Dim> mean_a = per_volume * spread(sum(sum_a)), mean_Z = per_volume * spread(sum(sum_Z));
  RotationSums<Dim> turning;  // divided by density
  for (int i = first; i < last; i += lanes)
    turning.add(volumes_of_four(V, i, last), places(i) - mean_Z, vector_at<Dim>(a, i));
  const auto omega = turning.rate();
  for (int i = first; i < last; i += lanes) {
    const Vec<Pack, Dim> rigid = RotationSums<Dim>::times(omega, places(i) - mean_Z) + mean_a;
    const Vec<Pack, Dim> left = vector_at<Dim>(a, i) - filled<Pack>(share) * rigid;
    if (i + lanes <= last)
      put(left, a, i);
    else
      for (int k = 0; k < Dim; ++k)
        for (int lane = 0; lane < last - i; ++lane) a[k][i + lane] = left[k][lane];
  }
}
/// Volume-weighted mean, [Lee2016] Eq. 51.
inline void subtract_mean(const ColumnsView<1>& f, const double* V, int first, int last, double share) {
  Pack volume{}, total{};
  for (int i = first; i < last; i += lanes) {
    const Pack V_i = volumes_of_four(V, i, last);
    volume += V_i;
    total += V_i * load(f[0] + i);
  }
  const double mean = sum(total) / sum(volume);
  for (int i = first; i < last; ++i) f[0][i] -= share * mean;
}

inline constexpr TermInfo projection_info{
    "projection",
    "a = internal acceleration + D(v) is replaced by the nearest a with Σ V a = 0, Σ V Z × a = 0",
    "[Lee2016] Eq. 45–51", "methods/tl_mixed/momentum_projection.hpp:project_on_momenta",
    "projection: the result is the nearest field without force and torque"};

}  // namespace taut
