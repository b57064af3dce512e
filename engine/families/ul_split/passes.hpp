#pragma once

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/solver/state.hpp"
#include "engine/terms/artificial_stress.hpp"
#include "engine/terms/equation_of_state.hpp"
#include "engine/terms/gradient_correction.hpp"
#include "engine/terms/riemann.hpp"
#include "engine/terms/shear.hpp"
#include "engine/terms/stress_rate.hpp"
#include "engine/terms/velocity_gradient.hpp"

/// Every loop over neighbours. All of them gather over i, so that no result depends on the number of threads.
namespace taut::inline TAUT_ISA {

/// e_ij, r_ij and ∂W/∂r of pack `b` of the pairs of i, from the positions.
template <const Formulation& M, int Dim>
PairGeometry<Dim> pair_geometry(const State<Dim>& s, const Constants& c, int i, int b) {
  using K = Kernel<M.kernel>;
  const double far = 2 * K::support * c.h;
  const int* j = s.neighbors.pack(b);
  Vec<Pack, Dim> d;
  for (int k = 0; k < Dim; ++k)
    d[k] = s.x[i][k] - Pack{s.x[j[0]][k], s.x[j[1]][k], s.x[j[2]][k], s.x[j[3]][k]};
  const Pack r2 = dot(d, d);
  const Pack r =
      root(r2 == 0 ? filled<Pack>(far * far) : r2);  // the filling and coincident particles: no force
  PairGeometry<Dim> pair;
  pair.inv_r = 1 / r;
  pair.e = pair.inv_r * d;
  pair.dW = K::alpha(Dim) / power<Dim + 1>(c.h) * K::dw(Pack(r / c.h));
  for (int lane = 0; lane < lanes; ++lane) {
    if (s.body[j[lane]] == s.body[i]) continue;
    pair.inv_r[lane] = 0;
    if (!s.sph_contact) pair.dW[lane] = 0;
  }
  return pair;
}

/// (W/W(dp))ⁿ of pack `b` of the pairs of i.
template <const Formulation& M, int Dim>
Pack pair_closeness(const State<Dim>& s, const Constants& c, int i, int b) {
  using K = Kernel<M.kernel>;
  const int* j = s.neighbors.pack(b);
  Pack closeness;
  for (int lane = 0; lane < lanes; ++lane) {
    const Vec<double, Dim> d = s.x[i] - s.x[j[lane]];
    closeness[lane] = std::pow(K::w(std::sqrt(dot(d, d)) / c.h) / K::w(c.dp / c.h), c.exponent);
  }
  return closeness;
}

/// The geometry of every pair, and the list of packs that hold pairs of two bodies which act as one.
template <const Formulation& M, int Dim>
void geometry_pass(State<Dim>& s, const Constants& c, int threads) {
  s.pairs.resize(s.neighbors.begin.back());
  if constexpr (M.artificial_stress) s.closeness.resize(s.pairs.size());
  parallel_for(s.size(), threads, [&](int i) {
    for (int b = s.neighbors.begin[i]; b < s.neighbors.begin[i + 1]; ++b) {
      s.pairs[b] = pair_geometry<M>(s, c, i, b);
      if constexpr (M.artificial_stress) s.closeness[b].value = pair_closeness<M>(s, c, i, b);
    }
  });
  s.contacts.clear();
  if (!s.sph_contact) return;
  for (int i = 0; i < s.size(); ++i) {
    const auto other_body = [&](int j) { return s.body[j] != s.body[i]; };
    for (int b = s.neighbors.begin[i]; b < s.neighbors.begin[i + 1]; ++b)
      if (std::any_of(s.neighbors.pack(b), s.neighbors.pack(b) + lanes, other_body))
        s.contacts.emplace_back(i, b);
  }
}

/// Between bodies geometry is not held: two that close at 2v would go half a spacing on stale gradients, come
/// apart on steeper ones than they met on, and stick.
/// Differs from [Zhang2024] §5, which holds all pairs between advection steps.
template <const Formulation& M, int Dim>
void contact_geometry_pass(State<Dim>& s, const Constants& c) {
  for (const auto& [i, b] : s.contacts) {
    const PairGeometry<Dim> now = pair_geometry<M>(s, c, i, b);
    PairGeometry<Dim>& pair = s.pairs[b];
    const auto inside = pair.inv_r > 0;
    for (int k = 0; k < Dim; ++k) pair.e[k] = inside ? pair.e[k] : now.e[k];
    pair.dW = inside ? pair.dW : now.dW;
  }
}

/// dv/dt of every particle: pressure from the Riemann problem of each pair, and shear.
/// `use(i, a)` receives each acceleration, m/s².
template <const Formulation& M, int Dim, class Use>
double momentum_pass(State<Dim>& s, const Constants& c, int threads, const Use& use) {
  const Dissipation dissipation{c.rho0 * c.c0, c.riemann_limiter / c.c0, c.beta_least};
  return parallel_max(s.size(), threads, [&](int i) TAUT_FLATTEN {
    const Flow<Dim, Pack> f_i = spread_flow(s.flow[i]);
    [[maybe_unused]] Tensor<Dim> s_i, R_i;
    if constexpr (carries_stress(M)) s_i = spread_tensor(s.stress[i]);
    if constexpr (M.artificial_stress) R_i = spread_tensor(s.repulsion[i]);
    Vec<Pack, Dim> force{};  // per volume, N/m³
    [[maybe_unused]] Vec<Pack, Dim> repulsion{};
    for (int b = s.neighbors.begin[i]; b < s.neighbors.begin[i + 1]; ++b) {
      const int* j = s.neighbors.pack(b);
      const PairGeometry<Dim>& g = s.pairs[b];
      const Flow<Dim, Pack> f_j = gather_flow(s.flow, j);
      const Pack closing_speed = -dot(f_i.v - f_j.v, g.e);
      const Pack p = riemann_pressure(f_i.p, f_j.p, closing_speed, dissipation);
      force -= Pack(2 * f_j.V * p * g.dW) * g.e;  // −2 Σ m_j P*/ρ_j ∇W, [Zhang2024] Eq. 12
      if constexpr (carries_stress(M))
        force += nested_shear_term(s_i.s, gather_tensor(s.stress, j).s, f_j.V, g.dW_inside(), g.e);
      if constexpr (M.artificial_stress) {
        const Tensor<Dim> R_j = gather_tensor(s.repulsion, j);
        repulsion += artificial_stress_term(R_i.s, R_j.s, R_j.a, s.closeness[b].value, g.dW, g.e);
      }
    }
    const double inv_rho = s.flow[i].c[Dim + 1] / s.m[i];
    Vec<double, Dim> a = inv_rho * sum(force);
    if constexpr (M.artificial_stress) a += sum(repulsion);
    if constexpr (!carries_stress(M)) a += s.a_shear[i];
    return use(i, a);
  });
}

/// The rates that follow from the new velocities: of density, and of the stress or the shear acceleration.
/// `use(i)` is called when those of particle i are there.
template <const Formulation& M, int Dim, bool pressure_diffusion, class Use>
void rate_pass(State<Dim>& s, const Constants& c, int threads, const Use& use) {
  parallel_for(s.size(), threads, [&](int i) TAUT_FLATTEN {
    const Flow<Dim, Pack> f_i = spread_flow(s.flow_new[i]);
    Pack compression{};  // 1/s
    [[maybe_unused]] Mat<Pack, Dim> L{};
    [[maybe_unused]] Vec<Pack, Dim> laplacian{};
    for (int b = s.neighbors.begin[i]; b < s.neighbors.begin[i + 1]; ++b) {
      const int* j = s.neighbors.pack(b);
      const PairGeometry<Dim>& g = s.pairs[b];
      const Flow<Dim, Pack> f_j = gather_flow(s.flow_new, j);
      const Vec<Pack, Dim> v_ij = f_i.v - f_j.v;
      compression += compression_term(f_j.V, g.dW, Pack(-dot(v_ij, g.e)));
      if constexpr (pressure_diffusion)
        compression += pressure_diffusion_term(f_j.V, g.dW, f_i.p, f_j.p, c.pressure_diffusion, c.rho0, c.c0);
      if constexpr (M.shear == Shear::nested_stress)
        add_velocity_gradient(L, f_j.V, g.dW_inside(), v_ij, g.e);
      if constexpr (M.shear == Shear::laplacian_velocity)
        laplacian += laplacian_term(v_ij, f_j.V, g.dW, g.inv_r, g.e);
      if constexpr (M.shear == Shear::laplacian_velocity_nonconservative)
        laplacian += laplacian_term_nonconservative(v_ij, f_j.V, g.dW, g.inv_r);
    }
    s.drho[i] = s.rho[i] * sum(compression);
    if constexpr (!strains_what_is_held(M)) s.drho[i] *= s.mobile[i];
    if constexpr (M.shear == Shear::nested_stress) s.ds[i] = jaumann_rate<M.deviator>(sum(L), s.s[i], c.G);
    // G/ρ stands inside the time integral: outside, as [Zhang2024] Eq. 20 prints it, m_i/ρ_i V_j would not be
    // V_i V_j of the same time and linear momentum would drift.
    const double inv_rho = s.flow_new[i].c[Dim + 1] / s.m[i];
    if constexpr (M.shear == Shear::laplacian_velocity)
      s.da_shear[i] = (c.zeta * c.G * inv_rho) * sum(laplacian);
    if constexpr (M.shear == Shear::laplacian_velocity_nonconservative)
      s.da_shear[i] = (c.G * inv_rho) * sum(laplacian);
    use(i);
  });
}

/// Brings the stress up to date that a method does not compute with, from the displacement d in `flow_new`
/// since it was last done: s += 2G dev ε(d) + rotation, with the corrected gradient.  [Zhang2024] Eq. 6–8,
/// 26, 27 The geometry of the pairs is held meanwhile, so that this is the integral over all steps since.
template <const Formulation& M, int Dim, class Use>
void stress_recovery_pass(const State<Dim>& s, const Constants& c, int threads, const Use& use) {
  parallel_for(s.size(), threads, [&](int i) {
    const Flow<Dim, Pack> f_i = spread_flow(s.flow_new[i]);
    Mat<Pack, Dim> gradient{};
    Sym<Pack, Dim> moment{};
    for (int b = s.neighbors.begin[i]; b < s.neighbors.begin[i + 1]; ++b) {
      const int* j = s.neighbors.pack(b);
      const PairGeometry<Dim>& g = s.pairs[b];
      const Flow<Dim, Pack> f_j = gather_flow(s.flow_new, j);
      const Pack dW = g.dW_inside();
      add_velocity_gradient(gradient, f_j.V, dW, f_i.v - f_j.v, g.e);
      add_gradient_moment(moment, f_j.V, dW, Pack(1 / max(g.inv_r, filled<Pack>(1e-300))), g.e);
    }
    const Mat<double, Dim> dL = product(sum(gradient), gradient_correction(sum(moment)));
    Sym<double, Dim> stress = s.s[i];
    use(i, stress += jaumann_rate<M.deviator>(dL, stress, c.G));
  });
}

}  // namespace taut::inline TAUT_ISA
