#pragma once

#include "engine/core/parallel.hpp"
#include "engine/methods/tl_displacement/fields.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

/// Advances x and computes u.
template <const TlDisplacementFormulation&, int Dim>
void drift(const TlDisplacementFields<Dim>& f, double dt, const Threads& threads) {
  parallel_for(f.groups(), threads, [&](int group) {
    const int first = lanes * group, count = f.size - first;
    const Vec<Pack, Dim> x = load_four(f.x + first, count) + filled<Pack>(dt) * load_four(f.v + first, count);
    store_four(x, f.x + first, count);
    put(x - load_four(f.X + first, count), f.displacement, first);
  });
}

template <int Dim>
Mat<Pack, Dim> deformation(const TlDisplacementFields<Dim>& f, int group) {
  Mat<Pack, Dim> F = product(f.pairs.difference_sum(f.displacement, group), f.sites[group].B);
  for (int k = 0; k < Dim; ++k) F(k, k) += 1;
  return F;
}

/// Computes V P(F) B.
template <const TlDisplacementFormulation& M, int Dim>
void stress_pass(const TlDisplacementFields<Dim>& f, const Threads& threads) {
  f.laws.template visit<M>([&]<class L>(const L* of_materials) {
    const LawsOfFour<L, M.several_materials> laws{of_materials, f.material};
    parallel_pass(f.groups(), threads, [&](int group) {
      const Mat<Pack, Dim> F = deformation(f, group);
      const Mat<Pack, Dim> P = laws(group, [&](const auto& law) { return law.piola(F, determinant(F)); });
      const Sites<Dim>& site = f.sites[group];
      put(product(P, site.V0 * site.B), f.stress, lanes * group);
    });
  });
}

/// Advances v by all forces, then x by half a step. Returns the maximum v², m²/s².
template <const TlDisplacementFormulation&, int Dim>
double force_pass(const TlDisplacementFields<Dim>& f, const Kick<Dim>& kick, const Threads& threads) {
  if (kick.impulse)
    parallel_for(f.groups(), threads,
                 [&](int group) { kick.record(lanes * group, f.pairs.pair_sum(f.stress, group)); });
  return parallel_max(f.groups(), threads, [&](int group) {
    const int first = lanes * group, count = f.size - first;
    const Sites<Dim>& site = f.sites[group];
    const Vec<Pack, Dim> v =
        kick.by_forces(first, site.mobile * site.per_m, f.pairs.pair_sum(f.stress, group));
    store_four(load_four(f.x + first, count) + filled<Pack>(0.5 * kick.dt) * v, f.x + first, count);
    return greatest(dot(v, v));
  });
}

template <const TlDisplacementFormulation&, int Dim>
void deform(const TlDisplacementFields<Dim>& f, const int* groups, int count, Mat<Pack, Dim>* out,
            const Threads& threads) {
  parallel_pass(count, threads, [&](int k) { out[k] = deformation(f, groups[k]); });
}

}  // namespace taut
