#pragma once

#include <algorithm>
#include <type_traits>

#include "engine/core/parallel.hpp"
#include "engine/methods/tl_mixed/corrected_laplacian.hpp"
#include "engine/methods/tl_mixed/fields.hpp"
#include "engine/methods/tl_mixed/momentum_projection.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

template <const TlMixedFormulation& M, int Dim>
struct UnknownsOf {
  using Mat = taut::Mat<Pack, Dim>;

  static constexpr bool has_J = follows_volume_ratio(M);
  static constexpr bool has_H = M.unknowns == Unknowns::v_F_H_J && Dim == 3;
  static constexpr int fields = Dim + has_J;  // columns of v and J

  static Pack volume_ratio(const Strains<Dim>& u, int group) {
    if constexpr (has_J)
      return u.J[group].value;
    else
      return determinant(u.F[group]);
  }
  static Mat cofactors(const Strains<Dim>& u, int group) {
    if constexpr (has_H)
      return u.H[group];
    else
      return cofactor(u.F[group]);
  }
  template <class L>
  static Mat piola(const L& law, const Strains<Dim>& u, int group) {
    if constexpr (has_H)
      return law.piola(u.F[group], u.H[group], u.J[group].value);
    else
      return law.piola(u.F[group], volume_ratio(u, group));
  }
  static auto pairs(const TlMixedFields<Dim>& f) {
    if constexpr (M.jst)
      return f.dissipating_pairs;
    else
      return f.pairs;
  }
  static ColumnsView<fields> own(const ColumnsView<Dim + 1>& columns) {
    return {columns.all, columns.length};
  }
};

/// `flow` contains x − X, m.
template <const TlMixedFormulation& M, int Dim>
void start_gradients(const TlMixedFields<Dim>& f) {
  using U = UnknownsOf<M, Dim>;
  for (int group = 0; group < f.groups(); ++group) {
    f.now.F[group] += product(U::pairs(f).difference_sum(U::own(f.flow), group), f.sites[group].B);
    if constexpr (U::has_J) f.now.J[group].value = determinant(f.now.F[group]);
    if constexpr (U::has_H) f.now.H[group] = cofactor(f.now.F[group]);
  }
}

/// Maximum stiffness_bound, Pa.
template <const TlMixedFormulation& M, int Dim>
double greatest_stiffness(const TlMixedFields<Dim>& f, const Threads& threads) {
  using U = UnknownsOf<M, Dim>;
  return f.laws.template visit<M>([&]<class L>(const L* of_materials) {
    const LawsOfFour<L, M.several_materials> laws{of_materials, f.material};
    return parallel_max(f.groups(), threads, [&](int group) {
      return greatest(laws(group, [&](const auto& law) {
        return law.stiffness_bound(f.now.F[group], U::volume_ratio(f.now, group));
      }));
    });
  });
}

/// stiffness_bound of each particle, Pa.
template <const TlMixedFormulation& M, int Dim>
void stiffnesses(const TlMixedFields<Dim>& f, AlignedPack* out) {
  using U = UnknownsOf<M, Dim>;
  f.laws.template visit<M>([&]<class L>(const L* of_materials) {
    const LawsOfFour<L, M.several_materials> laws{of_materials, f.material};
    for (int group = 0; group < f.groups(); ++group)
      out[group].value = laws(group, [&](const auto& law) {
        return law.stiffness_bound(f.now.F[group], U::volume_ratio(f.now, group));
      });
  });
}

/// Fills `flow` with (v, J) and `stress` with V P B, or P if one-sided.
template <const TlMixedFormulation& M, int Dim>
void set_columns(const TlMixedFields<Dim>& f, const Threads& threads) {
  using U = UnknownsOf<M, Dim>;
  f.laws.template visit<M>([&]<class L>(const L* of_materials) {
    const LawsOfFour<L, M.several_materials> laws{of_materials, f.material};
    parallel_pass(f.groups(), threads, [&](int group) {
      const int first = lanes * group;
      const Vec<Pack, Dim> v = load_four(f.v + first, f.size - first);
      for (int k = 0; k < Dim; ++k) store(v[k], f.flow[k] + first);
      if constexpr (U::has_J) store(f.now.J[group].value, f.flow[Dim] + first);
      const Mat<Pack, Dim> P = laws(group, [&](const auto& law) { return U::piola(law, f.now, group); });
      put(f.one_sided ? P : product(P, f.sites[group].V0 * f.sites[group].B), f.stress, first);
    });
  });
}

/// Rates without dissipation; for methods with dissipation also dp² L[U].
template <const TlMixedFormulation& M, int Dim>
void gather_pass(const TlMixedFields<Dim>& f, const Threads& threads) {
  using U = UnknownsOf<M, Dim>;
  const auto pairs = U::pairs(f);
  parallel_pass(f.groups(), threads, [&](int group) {
    const int first = lanes * group;
    Mat<Pack, Dim> sum;
    if constexpr (M.jst) {
      const auto both = differences_and_laplacian(pairs, U::own(f.flow), group);
      sum = both.differences;
      put(both.laplacian, U::own(f.once), first);
    } else {
      sum = pairs.difference_sum(U::own(f.flow), group);
    }
    const Mat<Pack, Dim> grad_v = product(sum, f.sites[group].B);
    f.rate.F[group] = grad_v;
    if constexpr (U::has_J) f.rate.J[group].value = contraction(U::cofactors(f.now, group), grad_v);
    if constexpr (U::has_H) f.rate.H[group] = tensor_cross(f.now.F[group], grad_v);
    const Sites<Dim>& site = f.sites[group];
    if (f.one_sided) [[unlikely]]
      put(site.V0 * site.per_m * pairs.one_sided_sum(f.stress, site.B, group), f.a, first);
    else
      put(site.per_m * pairs.pair_sum(f.stress, group), f.a, first);
  });
}
inline constexpr TermInfo volume_ratio_info{
    "volume ratio", "dJ/dt = H : Σ_j (v_j − v_i) ⊗ k_ij B_i, H = cof F", "[Lee2016] Eq. 33c",
    "methods/tl_mixed/passes.hpp:gather_pass", "mixed: a colliding ring and disc follow the transcription"};
inline constexpr TermInfo cofactor_info{
    "cofactor", "dH/dt = F ⨯ Σ_j (v_j − v_i) ⊗ k_ij B_i; H = cof F in 2D", "[Lee2016] Eq. 33b",
    "methods/tl_mixed/passes.hpp:gather_pass",
    "mixed: in 3D collisions and a block hit on its clamp follow the transcription"};

/// Adds the dissipation of velocity to `a`, and computes the dissipation of J. [Lee2016] Eq. 35–38
template <const TlMixedFormulation& M, int Dim>
void dissipation_pass(const TlMixedFields<Dim>& f, const TlMixedConstants& c, const Threads& threads) {
  using U = UnknownsOf<M, Dim>;
  if constexpr (M.jst) {
    constexpr int fields = U::fields;
    const double rate = f.wave_speed / c.dp;
    const ColumnsView<fields> of_once = U::own(f.once);
    parallel_pass(f.groups(), threads, [&](int group) {
      const Vec<Pack, fields> once = vector_at<fields>(of_once, lanes * group),
                              twice = second_laplacian(f.dissipating_pairs, of_once, group);
      Vec<Pack, Dim> a = vector_at<Dim>(f.a, lanes * group);
      for (int k = 0; k < Dim; ++k) a[k] += rate * (c.eps_v2 * once[k] - c.eps_v4 * twice[k]);
      put(a, f.a, lanes * group);
      if constexpr (U::has_J)
        store(rate * (c.eps_J2 * once[Dim] - c.eps_J4 * twice[Dim]), f.dissipation_J[0] + lanes * group);
    });
  }
}

/// Projects accelerations ([Lee2016] Eq. 45–49) and the dissipation of J (Eq. 51).
template <const TlMixedFormulation& M, int Dim>
void project(const TlMixedFields<Dim>& f, const TlMixedConstants& c, int first, int last) {
  project_on_momenta(f.a, f.x, f.V0, first, last, c.projection);
  if constexpr (UnknownsOf<M, Dim>::has_J) subtract_mean(f.dissipation_J, f.V0, first, last, c.projection);
}

template <int Dim, class F>
[[gnu::always_inline]] inline void each_of(const TlMixedFields<Dim>& f, int group, const F& use) {
  const int first = lanes * group, last = std::min(first + lanes, f.size);
  for (int i = first; i < last; ++i) use(i);
}

/// Adds the impulse of a stage.
template <int Dim>
[[gnu::noinline]] void watch(const TlMixedFields<Dim>& f, const Kick<Dim>& kick, int group,
                             Vec<Pack, Dim> a) {
  each_of(f, group, [&](int i) { kick.impulse[i] += (0.5 * kick.dt * f.m[i]) * lane_of(a, i % lanes); });
}

/// Returns dv/dt with contact and loads, m/s²; 0 for clamped particles.
template <int Dim>
[[gnu::always_inline]] inline Vec<Pack, Dim> acceleration(const TlMixedFields<Dim>& f, const Kick<Dim>& kick,
                                                          const StageActions<Dim>& actions, int group) {
  const int first = lanes * group;
  Vec<Pack, Dim> a = vector_at<Dim>(f.a, first);
  if (kick.contact) a += f.sites[group].per_m * load_four(kick.contact + first, f.size - first);
  if (kick.impulse) watch(f, kick, group, a);
  if (actions.load)
    each_of(f, group, [&](int i) {
      Vec<double, Dim> own = lane_of(a, i % lanes);
      actions.load(actions.of, i, own);
      set_lane(a, i % lanes, own);
    });
  return f.sites[group].mobile * a;
}

/// First stage, U* = U + Δt U̇(U). Driven particles take the velocity of the end of the step.
template <const TlMixedFormulation& M, int Dim>
void predict(const TlMixedFields<Dim>& f, const Kick<Dim>& kick, const StageActions<Dim>& actions,
             const Threads& threads) {
  using U = UnknownsOf<M, Dim>;
  const double dt = kick.dt;
  parallel_pass(f.groups(), threads, [&](int group) {
    const int first = lanes * group, count = f.size - first;
    f.start.F[group] = f.now.F[group];
    f.now.F[group] = combination(1.0, f.now.F[group], dt, f.rate.F[group]);
    if constexpr (U::has_J) {
      f.start.J[group] = f.now.J[group];
      f.now.J[group].value += dt * (f.rate.J[group].value + load(f.dissipation_J[0] + first));
    }
    if constexpr (U::has_H) {
      f.start.H[group] = f.now.H[group];
      f.now.H[group] = combination(1.0, f.now.H[group], dt, f.rate.H[group]);
    }
    const Vec<Pack, Dim> a = acceleration(f, kick, actions, group), v = load_four(f.v + first, count);
    put(a, f.a_start, first);
    store_four(v, f.v_start + first, count);
    store_four(v + filled<Pack>(dt) * a, f.v + first, count);
    if (actions.steer) each_of(f, group, [&](int i) { actions.steer(actions.of, i, f.v[i]); });
  });
}

/// Second stage, ½ (U + U* + Δt U̇(U*)). Returns the maximum v², m²/s².
template <const TlMixedFormulation& M, int Dim>
double correct(const TlMixedFields<Dim>& f, const Kick<Dim>& kick, const StageActions<Dim>& actions,
               const Threads& threads) {
  using U = UnknownsOf<M, Dim>;
  const double dt = kick.dt;
  return parallel_max(f.groups(), threads, [&](int group) {
    const int first = lanes * group, count = f.size - first;
    const auto mean = [&](const Mat<Pack, Dim>& at_start, const Mat<Pack, Dim>& now,
                          const Mat<Pack, Dim>& rate) {
      return combination(0.5, at_start + now, 0.5 * dt, rate);
    };
    f.now.F[group] = mean(f.start.F[group], f.now.F[group], f.rate.F[group]);
    if constexpr (U::has_J)
      f.now.J[group].value = 0.5 * (f.start.J[group].value + f.now.J[group].value +
                                    dt * (f.rate.J[group].value + load(f.dissipation_J[0] + first)));
    if constexpr (U::has_H) f.now.H[group] = mean(f.start.H[group], f.now.H[group], f.rate.H[group]);
    const Vec<Pack, Dim> a = vector_at<Dim>(f.a_start, first) + acceleration(f, kick, actions, group);
    Vec<Pack, Dim> v = load_four(f.v_start + first, count) + filled<Pack>(0.5 * dt) * a;
    if (actions.close)
      each_of(f, group, [&](int i) {
        Vec<double, Dim> own = lane_of(v, i % lanes);
        actions.close(actions.of, i, dt, f.v_start[i], own);
        set_lane(v, i % lanes, own);
      });
    store_four(v, f.v + first, count);
    return greatest(dot(v, v));
  });
}

/// Advances F, J and H with the velocities in `flow`.
template <const TlMixedFormulation& M, int Dim>
void follow(const TlMixedFields<Dim>& f, double dt, const Threads& threads) {
  using U = UnknownsOf<M, Dim>;
  const auto pairs = U::pairs(f);
  parallel_pass(f.groups(), threads, [&](int group) {
    const Mat<Pack, Dim> grad_v = product(pairs.difference_sum(U::own(f.flow), group), f.sites[group].B);
    if constexpr (U::has_J) f.now.J[group].value += dt * contraction(U::cofactors(f.now, group), grad_v);
    if constexpr (U::has_H)
      f.now.H[group] = combination(1.0, f.now.H[group], dt, tensor_cross(f.now.F[group], grad_v));
    f.now.F[group] = combination(1.0, f.now.F[group], dt, grad_v);
  });
}

}  // namespace taut
