#pragma once

#include <algorithm>

#include "engine/core/parallel.hpp"
#include "engine/kernels/kernel.hpp"
#include "engine/methods/ul_split/fields.hpp"
#include "engine/solver/kick.hpp"
#include "engine/terms/artificial_stress.hpp"
#include "engine/terms/equation_of_state.hpp"
#include "engine/terms/gradient_correction.hpp"
#include "engine/terms/hourglass/velocity_penalty.hpp"
#include "engine/terms/riemann.hpp"
#include "engine/terms/shear.hpp"
#include "engine/terms/stress_rate.hpp"
#include "engine/terms/velocity_gradient.hpp"

namespace taut {

template <KernelName Name, int Dim>
class PairKernel {
 public:
  explicit PairKernel(const UlSplitConstants& c)
      : per_h_(1 / c.h),
        alpha_(steepness(c)),
        least_(PairCache<Dim>::least * alpha_ * c.h),
        per_w_dp_(1 / K::w(c.dp / c.h)),
        exponent_(c.exponent) {}

  static double steepness(const UlSplitConstants& c) { return K::alpha(Dim) / power<Dim + 1>(c.h); }

  /// Geometry for x_i − x_j = d; 0 for coincident particles and padding.
  PairGeometry<Dim> geometry(const Vec<Pack, Dim>& d) const {
    Pack slope_per_distance;
    return geometry(d, slope_per_distance);
  }
  /// Also returns (∂W/∂r)/r, 1/m^(Dim+2).
  PairGeometry<Dim> geometry(const Vec<Pack, Dim>& d, Pack& slope_per_distance) const {
    const Pack r = root(dot(d, d));
    const Pack dW = alpha_ * K::dw(Pack(per_h_ * r));
    const Pack product = r * dW;
    const PackIndex acting = product < -least_;
    const Pack inverse = 1 / (acting ? product : filled<Pack>(1));
    const Pack inv_r = inverse * dW, inv_dW = inverse * r, none{};
    slope_per_distance = acting ? Pack(dW * inv_r) : none;
    return {slope_per_distance * d, acting ? inv_dW : none, acting ? inverse : none};
  }
  /// (W/W(dp))ⁿ
  Pack closeness(const Vec<Pack, Dim>& d) const {
    return power(Pack(per_w_dp_ * K::w(Pack(per_h_ * root(dot(d, d))))), exponent_);
  }

 private:
  using K = Kernel<Name>;
  double per_h_, alpha_, least_, per_w_dp_, exponent_;
};

template <const UlSplitFormulation& M, class F>
auto with_kernel(const UlSplitConstants& c, const F& f) {
  return c.cubic_spline != 0 ? f.template operator()<KernelName::cubic_spline>()
                             : f.template operator()<M.kernel>();
}

template <const UlSplitFormulation& M, int Dim>
double steepness(const UlSplitConstants& c) {
  return with_kernel<M>(c, [&]<KernelName Name>() { return PairKernel<Name, Dim>::steepness(c); });
}

template <const UlSplitFormulation& M, int Dim, KernelName Name>
void geometry_pass(const UlSplitFields<Dim>& s, const UlSplitConstants& c, const Threads& threads) {
  // position and body in place of v and p
  parallel_for(s.size, threads, [&](int i) { s.flow[i].set(s.x[i], s.body[i], s.m[i] / s.rho[i]); });
  parallel_pass(s.size, threads, [&, kernel = PairKernel<Name, Dim>(c)](int i) {
    const Flow<Dim, Pack> here = spread_flow(s.flow[i]);
    PackIndex outside{};
    [[maybe_unused]] Sym<Pack, Dim> moment{};
    for (int b = s.begin[i]; b < s.begin[i + 1]; ++b) {
      const Flow<Dim, Pack> there = gather_flow(s.flow, s.pack(b));
      const PackIndex inside = here.p == there.p;
      outside |= ~inside;
      const Vec<Pack, Dim> d = here.v - there.v;
      Pack slope_per_distance;
      PairGeometry<Dim> pair = kernel.geometry(d, slope_per_distance);
      if constexpr (integrates_shear(M))
        add_gradient_moment(moment, inside ? there.V : Pack{}, slope_per_distance, one, d);
      pair.inverse_distance = inside ? pair.inverse_distance : Pack{};
      if (!s.sph_contact) {
        for (int k = 0; k < Dim; ++k) pair.gradient[k] = inside ? pair.gradient[k] : Pack{};
        pair.inverse_slope = inside ? pair.inverse_slope : Pack{};
      }
      s.pairs.set(b, pair);
      if constexpr (M.artificial_stress) s.pairs.set_closeness(b, kernel.closeness(d));
    }
    s.has_foreign_neighbors[i] = any(outside);
    if constexpr (integrates_shear(M)) s.recovery[i].set(gradient_correction(sum(moment)), here.V[0]);
  });
}

template <const UlSplitFormulation& M, int Dim>
void geometry_pass(const UlSplitFields<Dim>& s, const UlSplitConstants& c, const Threads& threads) {
  with_kernel<M>(c, [&]<KernelName Name>() { geometry_pass<M, Dim, Name>(s, c, threads); });
}

/// Recomputes pairs of two bodies. Departure: [Zhang2024] §5 caches these, too; bodies then stick.
template <const UlSplitFormulation& M, int Dim, KernelName Name>
void contact_geometry_pass(const UlSplitFields<Dim>& s, const UlSplitConstants& c) {
  const PairKernel<Name, Dim> kernel(c);
  for (int m = 0; m < s.mixed_count; ++m) {
    const auto [i, b] = s.mixed[m];
    const int* j = s.pack(b);
    PairGeometry<Dim> pair = s.pairs[b];
    Vec<Pack, Dim> d;
    PackIndex inside;
    for (int lane = 0; lane < lanes; ++lane) {
      for (int k = 0; k < Dim; ++k) d[k][lane] = s.x[i][k] - s.x[j[lane]][k];
      inside[lane] = s.body[j[lane]] == s.body[i] ? -1 : 0;
    }
    const PairGeometry<Dim> now = kernel.geometry(d);
    for (int k = 0; k < Dim; ++k) pair.gradient[k] = inside ? pair.gradient[k] : now.gradient[k];
    pair.inverse_slope = inside ? pair.inverse_slope : now.inverse_slope;
    s.pairs.set(b, pair);
    if constexpr (M.artificial_stress)
      s.pairs.set_closeness(b, inside ? s.pairs.closeness(b) : kernel.closeness(d));
  }
}

template <const UlSplitFormulation& M, int Dim>
void contact_geometry_pass(const UlSplitFields<Dim>& s, const UlSplitConstants& c) {
  with_kernel<M>(c, [&]<KernelName Name>() { contact_geometry_pass<M, Dim, Name>(s, c); });
}

/// ∇_i W; 0 for pairs of two bodies.
template <int Dim>
Vec<Pack, Dim> gradient_inside(const UlSplitFields<Dim>& s, int i, int b) {
  Vec<Pack, Dim> g = s.pairs.gradient(b);
  if (s.has_foreign_neighbors[i])
    for (int k = 0; k < Dim; ++k) g[k] = s.pairs.inverse_distance(b) < 0 ? g[k] : Pack{};
  return g;
}

/// Advances v (Eq. 24), then x to the end of the step (Eq. 25). Terms receive `one` and ∇_i W in place of ∂W/∂r and
/// e_ij. Returns the maximum v², m²/s².
template <const UlSplitFormulation& M, int Dim>
double momentum_pass(const UlSplitFields<Dim>& s, const UlSplitConstants& c, const Kick<Dim>& kick,
                     const Threads& threads) {
  const Dissipation dissipation{c.rho0 * c.c0, c.riemann_limiter / c.c0, c.beta_least};
  return parallel_max(s.size, threads, [&](int i) {
    const Flow<Dim, Pack> f_i = spread_flow(s.flow[i]);
    [[maybe_unused]] Tensor<Dim> s_i, R_i;
    if constexpr (carries_stress(M)) s_i = spread_tensor(s.stress[i]);
    if constexpr (M.artificial_stress) R_i = spread_tensor(s.repulsion[i]);
    Vec<Pack, Dim> force{};  // N/m³
    [[maybe_unused]] Vec<Pack, Dim> repulsion{};
    for (int b = s.begin[i]; b < s.begin[i + 1]; ++b) {
      const int* j = s.pack(b);
      const Vec<Pack, Dim> grad_W = s.pairs.gradient(b);
      const Flow<Dim, Pack> f_j = gather_flow(s.flow, j);
      const Pack closing_speed = s.pairs.inverse_slope(b) * dot(f_j.v - f_i.v, grad_W);
      const Pack p = riemann_pressure(f_i.p, f_j.p, closing_speed, dissipation);
      force -= Pack(2 * f_j.V * p) * grad_W;  // [Zhang2024] Eq. 12
      if constexpr (carries_stress(M))
        force += nested_shear_term(s_i.s, gather_tensor(s.stress, j).s, f_j.V, one, gradient_inside(s, i, b));
      if constexpr (M.artificial_stress) {
        const Tensor<Dim> R_j = gather_tensor(s.repulsion, j);
        repulsion += artificial_stress_term(R_i.s, R_j.s, R_j.a, s.pairs.closeness(b), one, grad_W);
      }
    }
    const double inv_rho = s.flow[i].c[Dim + 1] / s.m[i];
    Vec<double, Dim> a = inv_rho * sum(force);
    if constexpr (M.artificial_stress) a += sum(repulsion);
    if constexpr (integrates_shear(M)) a += s.a_shear[i];
    const Vec<double, Dim> v = kick.by_acceleration(i, a);
    s.x[i] += (0.5 * kick.dt) * v;
    const FlowRow<Dim>& old = s.flow[i];
    s.flow_new[i].set(v, old.c[Dim], old.c[Dim + 1]);
    return dot(v, v);
  });
}

/// Force of body `b` on `a` in the last momentum_pass, N.
template <const UlSplitFormulation& M, int Dim>
Vec<double, Dim> force_between(const UlSplitFields<Dim>& s, const UlSplitConstants& c, int a, int b) {
  const Dissipation dissipation{c.rho0 * c.c0, c.riemann_limiter / c.c0, c.beta_least};
  Vec<double, Dim> total{};
  for (int m = 0; m < s.mixed_count; ++m) {
    const auto [i, pack] = s.mixed[m];
    if (s.body[i] != a) continue;
    const int* j = s.pack(pack);
    Vec<Pack, Dim> grad_W = s.pairs.gradient(pack);
    for (int lane = 0; lane < lanes; ++lane)
      for (int k = 0; k < Dim && s.body[j[lane]] != b; ++k) grad_W[k][lane] = 0;
    const Flow<Dim, Pack> f_i = spread_flow(s.flow[i]), f_j = gather_flow(s.flow, j);
    const Pack closing_speed = s.pairs.inverse_slope(pack) * dot(f_j.v - f_i.v, grad_W);
    const Pack p = riemann_pressure(f_i.p, f_j.p, closing_speed, dissipation);
    total -= sum(Pack(2 * f_i.V * f_j.V * p) * grad_W);
    if constexpr (M.artificial_stress) {
      const Tensor<Dim> R_i = spread_tensor(s.repulsion[i]), R_j = gather_tensor(s.repulsion, j);
      total +=
          s.m[i] * sum(artificial_stress_term(R_i.s, R_j.s, R_j.a, s.pairs.closeness(pack), one, grad_W));
    }
  }
  return total;
}

/// Requires the velocity gradients of all particles.
template <const UlSplitFormulation& M, int Dim>
void penalty_pass(const UlSplitFields<Dim>& s, const UlSplitConstants& c, double dt, const Threads& threads) {
  parallel_pass(s.size, threads, [&](int i) {
    const Flow<Dim, Pack> f_i = spread_flow(s.flow_new[i]);
    const Mat<Pack, Dim> L_i = spread_gradient(s.velocity_gradient[i]);
    Vec<Pack, Dim> penalty{};
    for (int b = s.begin[i]; b < s.begin[i + 1]; ++b) {
      const Vec<Pack, Dim> grad_W = gradient_inside(s, i, b);
      const Flow<Dim, Pack> f_j = gather_flow(s.flow_new, s.pack(b));
      const Mat<Pack, Dim> L_sum = L_i + gather_gradient(s.velocity_gradient, s.pack(b));
      const Pack slope_over_r = dot(grad_W, grad_W) * s.pairs.inverse_distance(b);
      const Vec<Pack, Dim> term = velocity_penalty_term(f_i.v - f_j.v, L_sum, f_j.V, slope_over_r, grad_W);
      if constexpr (M.central_penalty)
        penalty += central_velocity_penalty_term(term, s.pairs.inverse_slope(b) * grad_W);
      else
        penalty += term;
    }
    const double inv_rho = s.flow_new[i].c[Dim + 1] / s.m[i];
    s.da_shear[i] = (c.xi * c.G * inv_rho) * sum(penalty);
    s.a_shear[i] += dt * s.da_shear[i];
  });
}

/// Second half step, Eq. 25.
template <const UlSplitFormulation& M, int Dim, bool pressure_diffusion>
void rate_pass(const UlSplitFields<Dim>& s, const UlSplitConstants& c, const Steering<Dim>& steering,
               double dt, const Threads& threads) {
  parallel_pass(s.size, threads, [&](int i) {
    const Flow<Dim, Pack> f_i = spread_flow(s.flow_new[i]);
    Pack compression{};  // 1/s
    [[maybe_unused]] Mat<Pack, Dim> L{};
    [[maybe_unused]] Vec<Pack, Dim> laplacian{};
    for (int b = s.begin[i]; b < s.begin[i + 1]; ++b) {
      const Vec<Pack, Dim> grad_W = s.pairs.gradient(b);
      const Flow<Dim, Pack> f_j = gather_flow(s.flow_new, s.pack(b));
      const Vec<Pack, Dim> v_ij = f_i.v - f_j.v;
      compression += compression_term(f_j.V, one, Pack(-dot(v_ij, grad_W)));
      if constexpr (pressure_diffusion) {
        const Pack slope = -root(dot(grad_W, grad_W));
        compression +=
            pressure_diffusion_term(f_j.V, slope, f_i.p, f_j.p, c.pressure_diffusion, c.rho0, c.c0);
      }
      if constexpr (carries_stress(M)) add_velocity_gradient(L, f_j.V, one, v_ij, gradient_inside(s, i, b));
      if constexpr (M.shear == Shear::laplacian_velocity)
        laplacian += laplacian_term(v_ij, f_j.V, one, s.pairs.inverse_distance(b), grad_W);
      if constexpr (M.shear == Shear::laplacian_velocity_nonconservative)
        laplacian +=
            laplacian_term_nonconservative(v_ij, f_j.V, dot(grad_W, grad_W), s.pairs.inverse_distance(b));
    }
    s.drho[i] = s.rho[i] * sum(compression);
    if constexpr (!strains_clamped(M)) s.drho[i] *= s.mobile[i];
    if constexpr (carries_stress(M)) {
      Mat<double, Dim> gradient = sum(L);
      if constexpr (has_penalty(M)) {
        gradient = product(gradient, s.recovery[i].get());
        s.velocity_gradient[i].set(gradient);
        if (M.central_penalty && c.penalty_rotation != 0)
          s.a_shear[i] = rotated_by_spin(gradient, s.a_shear[i], 2 * dt);
      }
      s.ds[i] = jaumann_rate<M.deviator>(gradient, s.s[i], c.G);
    }
    // Departure: G/ρ is inside the time integral; outside ([Zhang2024] Eq. 20) linear momentum would drift
    const double inv_rho = s.flow_new[i].c[Dim + 1] / s.m[i];
    if constexpr (M.shear == Shear::laplacian_velocity)
      s.da_shear[i] = (c.zeta * c.G * inv_rho) * sum(laplacian);
    if constexpr (M.shear == Shear::laplacian_velocity_nonconservative)
      s.da_shear[i] = (c.G * inv_rho) * sum(laplacian);
    if constexpr (!strains_clamped(M))
      if (steering.drives(s.id[i])) s.drho[i] = 0;
    s.rho[i] += dt * s.drho[i];
    if constexpr (carries_stress(M))
      s.s[i] += dt * s.ds[i];
    else
      s.a_shear[i] += dt * s.da_shear[i];
  });
  if constexpr (has_penalty(M)) penalty_pass<M>(s, c, dt, threads);
}
template <const UlSplitFormulation& M, int Dim>
void rate_pass(const UlSplitFields<Dim>& s, const UlSplitConstants& c, const Steering<Dim>& steering,
               double dt, const Threads& threads) {
  if (c.pressure_diffusion == 0)
    rate_pass<M, Dim, false>(s, c, steering, dt, threads);
  else
    rate_pass<M, Dim, true>(s, c, steering, dt, threads);
}

/// Stress of `particles` (null: all) from the displacement since the last recovery, [Zhang2024] Eq. 6–8, 26, 27.
/// Departure: volumes and gradient correction are also cached.
template <const UlSplitFormulation& M, int Dim>
void recover_stress(const UlSplitFields<Dim>& s, const UlSplitConstants& c, const FlowRow<Dim>* displacement,
                    const int* particles, int count, Sym<double, Dim>* out, const Threads& threads) {
  parallel_pass(count, threads, [&](int k) {
    const int i = particles ? particles[k] : k;
    const Flow<Dim, Pack> f_i = spread_flow(displacement[i]);
    Mat<Pack, Dim> gradient{};
    for (int b = s.begin[i]; b < s.begin[i + 1]; ++b) {
      const Flow<Dim, Pack> f_j = gather_flow(displacement, s.pack(b));
      add_velocity_gradient(gradient, f_j.V, one, f_i.v - f_j.v, gradient_inside(s, i, b));
    }
    const Mat<double, Dim> dL = product(sum(gradient), s.recovery[i].get());
    Sym<double, Dim> stress = s.s[i];
    stress += jaumann_rate<M.deviator>(dL, stress, c.G);
    out[k] = stress;
  });
}

/// First half step, Eq. 23. Departure: shear also advances.
template <const UlSplitFormulation& M, int Dim>
void half_drift(const UlSplitFields<Dim>& s, const UlSplitConstants& c, double dt, const Threads& threads) {
  parallel_pass(s.size, threads, [&](int i) {
    s.x[i] += dt * s.v[i];
    s.rho[i] += dt * s.drho[i];
    const double p = pressure(s.rho[i], c.rho0, c.c0);
    s.flow[i].set(s.v[i], p, s.m[i] / s.rho[i]);
    if constexpr (carries_stress(M)) {
      s.s[i] += dt * s.ds[i];
      s.stress[i].set(s.s[i]);
    }
    if constexpr (integrates_shear(M)) s.a_shear[i] += dt * s.da_shear[i];
    if constexpr (M.artificial_stress) {
      Sym<double, Dim> sigma = s.s[i];
      for (int k = 0; k < Dim; ++k) sigma(k, k) -= p;
      s.repulsion[i].set(artificial_stress(sigma, s.rho[i], c.epsilon), s.m[i]);
    }
  });
}

}  // namespace taut
