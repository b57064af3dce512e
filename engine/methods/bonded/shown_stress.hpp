#pragma once

#include <algorithm>

#include "engine/core/cube_root.hpp"
#include "engine/core/tensor.hpp"
#include "engine/materials/law.hpp"
#include "engine/methods/bonded/layout/recovered_gradient.hpp"

namespace taut {

/// Stress for snapshots, from the material law without its continuation below J = ½.
template <class T, int Dim>
struct alignas(alignment_of<T>) ShownStress {
  T J, p;         // p positive in compression, Pa
  Sym<T, Dim> s;  // deviator, Pa
  T s_zz;         // out of plane, in 2D, Pa
};

/// In the deviator, J is limited to at least 0.05.
template <int Dim>
ShownStress<Pack, Dim> shown_neo_hookean(const Pack& K, const Pack& G, const Mat<Pack, Dim>& F) {
  const Pack J = determinant(F), root = inverse_cube_root(max(J, filled<Pack>(0.05)));
  Sym<Pack, Dim> b{};
  for (int a = 0; a < Dim; ++a)
    for (int k = a; k < Dim; ++k)
      for (int l = 0; l < Dim; ++l) b(a, k) += F(a, l) * F(k, l);
  const Pack mean = (trace(b) + (3 - Dim)) / 3, shear = G * power<5>(root);
  for (int k = 0; k < Dim; ++k) b(k, k) -= mean;
  return {J, -K * (J - 1), shear * b, shear * (1 - mean)};
}

/// Below J = 0.05 only the pressure −K (J − 1).
template <class L, int Dim>
ShownStress<double, Dim> shown_stress(const L& law, const Mat<double, Dim>& F) {
  const double J = determinant(F);
  if (!(J >= 0.05)) return {J, -law.K * (J - 1), {}, 0};
  auto [sigma, zz] = law.cauchy(F, J);
  const double p = -(trace(sigma) + zz) / 3;
  for (int k = 0; k < Dim; ++k) sigma(k, k) += p;
  return {J, p, sigma, zz + p};
}

/// F, replaced by the recovered gradient of particles that have one. `u`: displacements in m.
template <int Dim>
Mat<Pack, Dim> recovered_deformations(const RecoveredView& recovered, const AlignedPack* u, int size,
                                      int first, Mat<Pack, Dim> F) {
  const int count = std::min(lanes, size - first);
  for (int lane = 0; lane < count; ++lane) {
    const int i = first + lane, begin = recovered.begin[i], end = recovered.begin[i + 1];
    if (begin == end) continue;
    Pack column[Dim]{};
    for (int k = 0; k < Dim; ++k) column[k][k] = 1;
    const auto add_steps = [&](const auto* g) {
      for (int b = begin; b < end; ++b, g += Dim) {
        const Pack step = u[recovered.j[b]].value - u[i].value;
#pragma GCC unroll 3
        for (int k = 0; k < Dim; ++k) column[k] += step * g[k];
      }
    };
    const int row = recovered.row[i];
    !recovered.halved ? add_steps(recovered.g + row) : add_steps(recovered.halved + row);
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) F(a, k)[lane] = column[k][a];
  }
  return F;
}

/// Scales the recovered F to the volume ratio `J` of the own F, except where `recovered.between` is 1.
template <int Dim>
void keep_volume(const RecoveredView& recovered, int size, int first, Mat<Pack, Dim>& F, const Pack& J) {
  const Pack least = filled<Pack>(0.05);  // for crushed or inverted particles
  const Pack ratio = max(J, least) / max(determinant(F), least);
  const Pack root = inverse_cube_root(ratio);
  Pack scale = ratio * root * root;
  for (int lane = 0; recovered.between && lane < lanes && first + lane < size; ++lane)
    if (recovered.between[first + lane]) scale[lane] = 1;
  F = scale * F;
}

}  // namespace taut
