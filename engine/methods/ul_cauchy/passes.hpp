#pragma once

#include <cmath>

#include "engine/core/parallel.hpp"
#include "engine/methods/ul_cauchy/fields.hpp"
#include "engine/solver/kick.hpp"
#include "engine/terms/artificial_stress.hpp"
#include "engine/terms/artificial_viscosity.hpp"
#include "engine/terms/density_diffusion.hpp"
#include "engine/terms/equation_of_state.hpp"
#include "engine/terms/gradient_correction.hpp"
#include "engine/terms/riemann_second_order.hpp"
#include "engine/terms/stress_divergence.hpp"
#include "engine/terms/stress_rate.hpp"
#include "engine/terms/tensile_instability_control.hpp"
#include "engine/terms/velocity_gradient.hpp"
#include "engine/terms/xsph.hpp"

namespace taut {

/// Padding has w′/q = 0 and r beyond the support.
template <int Dim>
struct CauchyPair {
  Vec<Pack, Dim> d;  // x_i − x_j, m
  Pack r;            // m
  Pack dw_per_q;     // w′(q)/q
};

/// To avoid divisions, terms get w′/q, `one` and x_i − x_j in place of ∂W/∂r, r and e_ij; α/h^(Dim+2) scales their
/// sums.
template <const UlCauchyFormulation& M, int Dim>
struct KernelScale {
  using K = Kernel<M.kernel>;
  double per_h, of_W, of_gradient, beyond2;

  explicit KernelScale(double h)
      : per_h(1 / h),
        of_W(K::alpha(Dim) / power<Dim>(h)),
        of_gradient(K::alpha(Dim) / power<Dim + 2>(h)),
        beyond2(power<2>(2 * K::support * h)) {}

  CauchyPair<Dim> pair(const Vec<Pack, Dim>& d) const {
    const Pack r2 = dot(d, d);
    const Pack r = root(r2 == 0 ? filled<Pack>(beyond2) : r2);  // padding and coincident particles
    return {d, r, K::dw_per_q(Pack(per_h * r))};
  }
};

template <const UlCauchyFormulation& M, int Dim>
void set_stress(const UlCauchyFields<Dim>& f, const UlCauchyConstants& c, int i, const Gradients<Dim>& g) {
  using Row = StressRow<M, Dim>;
  Row& row = f.template stress_rows<M>()[i];
  const double rho = f.rho[i], c0 = f.material_of(i).c0;
  row.put(Row::v_at, f.v[i]);
  row.put(Row::rho_at, rho);
  row.put(Row::V_at, f.m[i] / rho);
  Sym<double, Dim> sigma = f.s[i];
  for (int k = 0; k < Dim; ++k) sigma(k, k) -= pressure(rho, f.material_of(i).rho0, c0);
  const double scale = M.pair_stress == PairStress::squares ? 1 / (rho * rho) : 1;
  const auto acting = [&](const Sym<double, Dim>& stress) {
    if constexpr (M.corrected)
      return product(stress, g.L);
    else
      return full(scale * stress);
  };
  row.put(Row::T_at, acting(sigma));
  if constexpr (M.artificial_stress) f.repulsion[i].set(acting(-1.0 * positive_part(sigma)));
  if constexpr (M.viscosity == Viscosity::artificial) row.put(Row::wave_at, c0);
  if constexpr (M.viscosity == Viscosity::riemann) {
    row.put(Row::D_at, g.D);
    row.put(Row::root_rho_at, std::sqrt(rho));
    row.put(Row::wave_at, c0 * rho * std::sqrt(rho));
  }
  if constexpr (M.density_diffusion) row.put(Row::grad_rho_at, g.grad_rho);
  if constexpr (M.tensile_control) row.put(Row::surface_at, g.colour < c.surface_colour);
}

template <const UlCauchyFormulation& M, int Dim>
void gradient_pass(const UlCauchyFields<Dim>& f, const UlCauchyConstants& c, const Threads& threads) {
  using K = Kernel<M.kernel>;
  const KernelScale<M, Dim> scale(c.h);
  parallel_pass(f.size, threads, [&](int i) {
    const Motion<Dim> a = spread_motion(f.motion[i]);
    Sym<Pack, Dim> moment{};
    [[maybe_unused]] Mat<Pack, Dim> L{};
    [[maybe_unused]] Vec<Pack, Dim> grad_rho{};
    [[maybe_unused]] Pack colour{};
    for (int b = f.begin[i]; b < f.begin[i + 1]; ++b) {
      const Motion<Dim> o = gather_motion(f.motion, f.pack(b));
      const auto [d, r, dw_per_q] = scale.pair(a.x - o.x);
      [[maybe_unused]] const Pack w = K::w(Pack(scale.per_h * r));
      if constexpr (needs_kernel(M)) f.w[b].value = w;
      if constexpr (M.corrected) add_gradient_moment(moment, o.V, dw_per_q, one, d);
      if constexpr (M.viscosity == Viscosity::riemann) add_velocity_gradient(L, o.V, dw_per_q, a.v - o.v, d);
      if constexpr (M.density_diffusion)
        grad_rho += density_gradient_term(a.rho, o.rho, Pack(f.same_material(b) * o.V), dw_per_q, d);
      if constexpr (M.tensile_control) colour += colour_term(w, o.V);
    }
    Gradients<Dim> result;
    if constexpr (M.corrected) result.L = gradient_correction(scale.of_gradient * sum(moment));
    if constexpr (M.viscosity == Viscosity::riemann)
      result.D = symmetric_part(product(scale.of_gradient * sum(L), result.L));
    if constexpr (M.density_diffusion)
      result.grad_rho = c.delta_order * (result.L * (scale.of_gradient * sum(grad_rho)));
    if constexpr (M.tensile_control)
      result.colour = scale.of_W * (sum(colour) + colour_term(K::w(0.0), a.V[0]));
    set_stress<M>(f, c, i, result);
  });
}

/// Artificial stress without the factors ε and α/h^(Dim+2).
template <const UlCauchyFormulation& M, int Dim, RepulsionWeight weight>
class Repulsion {
 public:
  explicit Repulsion(const UlCauchyConstants& c)
      : scale_(c.h), dp_(c.dp), per_w_dp_(1 / K::w(c.dp / c.h)), exponent_(c.exponent) {}

  Vec<Pack, Dim> term(const UlCauchyFields<Dim>& f, const Mat<Pack, Dim>& R_i, int b,
                      const CauchyPair<Dim>& pair, const Pack& mass) const {
    const Pack close = weight == RepulsionWeight::distance
                           ? distance_weight(pair.r, dp_, exponent_)
                           : power(Pack(per_w_dp_ * f.w[b].value), exponent_);  // (W/W(dp))ⁿ
    const Mat<Pack, Dim> R_j = RepulsionRow<Dim>::gather(f.repulsion, f.pack(b));
    return stress_divergence_term(R_i, R_j, Pack(close * mass), pair.dw_per_q, pair.d);
  }
  Vec<double, Dim> of_all(const UlCauchyFields<Dim>& f, int i) const {
    const Mat<Pack, Dim> R_i = spread(f.repulsion[i].get());
    Vec<Pack, Dim> all{};
    for (int b = f.begin[i]; b < f.begin[i + 1]; ++b)
      all += term(f, R_i, b, scale_.pair(f.apart(i, b)),
                  StressRow<M, Dim>::gather(f.template stress_rows<M>(), f.pack(b)).weight());
    return sum(all);
  }

 private:
  using K = Kernel<M.kernel>;
  KernelScale<M, Dim> scale_;
  double dp_, per_w_dp_, exponent_;
};

/// Advances v over the whole step. Returns the maximum v², m²/s².
template <const UlCauchyFormulation& M, int Dim, RepulsionWeight weight = RepulsionWeight::kernel>
double stress_pass(const UlCauchyFields<Dim>& f, const UlCauchyConstants& c, const Kick<Dim>& kick,
                   const Threads& threads) {
  if constexpr (chooses_repulsion_weight(M) && weight == RepulsionWeight::kernel)
    if (c.repulsion_weight != 0) return stress_pass<M, Dim, RepulsionWeight::distance>(f, c, kick, threads);
  using Row = StressRow<M, Dim>;
  const KernelScale<M, Dim> scale(c.h);
  const Row* const rows = f.template stress_rows<M>();
  [[maybe_unused]] const auto limiter = static_cast<Limiter>(c.limiter);
  return parallel_max(f.size, threads, [&, repulsion = Repulsion<M, Dim, weight>(c)](int i) {
    const auto a = Row::spread(rows[i]);
    Vec<Pack, Dim> force{};
    constexpr bool everywhere = M.artificial_stress && !M.tensile_control;
    [[maybe_unused]] Mat<Pack, Dim> R_i;
    if constexpr (everywhere) R_i = spread(f.repulsion[i].get());
    [[maybe_unused]] Vec<Pack, Dim> sum_gradient{}, sum_repulsion{};
    [[maybe_unused]] Pack diffusion{}, surface_neighbors{};
    for (int b = f.begin[i]; b < f.begin[i + 1]; ++b) {
      const auto o = Row::gather(rows, f.pack(b));
      const CauchyPair<Dim> pair = scale.pair(f.apart(i, b));
      const auto& [d, r, dw_per_q] = pair;
      force += stress_divergence_term(a.T(), o.T(), o.weight(), dw_per_q, d);
      if constexpr (everywhere) sum_repulsion += repulsion.term(f, R_i, b, pair, o.weight());
      const Pack approach = -dot(a.v() - o.v(), d);  // closing speed times r, m²/s
      if constexpr (M.viscosity == Viscosity::artificial) {
        const Pack Pi = artificial_viscosity(approach, Pack(r * r), Pack(0.5 * (a.c() + o.c())),
                                             Pack(0.5 * (a.rho() + o.rho())), c.alpha, c.h);
        const Pack unit = M.pair_stress == PairStress::squares ? filled<Pack>(1) : a.rho();
        force += Pack(unit * o.rho() * o.V() * Pi * dw_per_q) * d;
      }
      if constexpr (M.viscosity == Viscosity::riemann) {
        const Pack r_speed = limiter == Limiter::none
                                 ? reconstructed_closing_speed(approach, a.D(), o.D(), one, d)
                                 : limited_closing_speed(approach, a.D(), o.D(), one, d, limiter);
        const Pack p = riemann_dissipation(r_speed, a.impedance(), o.impedance(), Pack(r * a.root_rho()),
                                           Pack(r * o.root_rho()));
        force -= Pack(c.riemann_factor * p * (o.V() * dw_per_q)) * d;
      }
      if constexpr (M.tensile_control) {
        sum_gradient += Pack(o.V() * dw_per_q) * d;
        surface_neighbors += r < c.vicinity * c.dp ? o.surface() : Pack{};
      }
      if constexpr (M.density_diffusion)
        diffusion += f.same_material(b) * density_diffusion_term(a.rho(), o.rho(), a.grad_rho(), o.grad_rho(),
                                                                 o.V(), dw_per_q, one, d);
    }
    Vec<double, Dim> total = sum(force);
    if constexpr (M.tensile_control) {
      if (a.surface()[0] == 0 && sum(surface_neighbors) == 0)
        total += tensile_control(f.repulsion[i].get(), sum(sum_gradient));
      else
        total += (c.surface_artificial_stress * c.epsilon) * repulsion.of_all(f, i);
    } else if constexpr (everywhere) {
      total += c.epsilon * sum(sum_repulsion);
    }
    if constexpr (M.pair_stress == PairStress::product) total = (1 / a.rho()[0]) * total;
    const double drho = M.density_diffusion ? c.delta * c.h * c.c0 * scale.of_gradient * sum(diffusion) : 0.0;
    const Vec<double, Dim> v = kick.by_acceleration(i, scale.of_gradient * total);
    f.drho[i] = drho;
    f.moved[i] = f.motion[i];
    f.moved[i].put_velocity(v);
    return dot(v, v);
  });
}

/// û of [Khayyer2024] Eq. 14, and positions after `ahead`, in s. Returns the maximum squared velocity relative to the
/// body's rigid motion, m²/s².
template <const UlCauchyFormulation& M, int Dim>
double transport_pass(const UlCauchyFields<Dim>& f, const UlCauchyConstants& c, const Steering<Dim>& steering,
                      double ahead, const Threads& threads) {
  const double of_W = KernelScale<M, Dim>(c.h).of_W;
  return parallel_max(f.size, threads, [&](int i) {
    Vec<double, Dim> u_minus_v{};
    if constexpr (M.transport_velocity) {
      const Motion<Dim> a = spread_motion(f.moved[i]);
      Vec<Pack, Dim> du{};
      for (int b = f.begin[i]; b < f.begin[i + 1]; ++b) {
        const Motion<Dim> o = gather_motion_only(f.moved, f.pack(b));
        du += xsph_term(a.v - o.v, a.rho, o.rho, o.V, f.w[b].value);
      }
      u_minus_v = (c.xsph * of_W) * sum(du);
    }
    Vec<double, Dim> u = f.v[i];
    if (!steering.drives(f.id[i])) {
      u += f.mobile[i] * u_minus_v;
      steering.constrain(f.id[i], u);
    }
    Vec<double, Dim> x = f.x[i];
    x += ahead * u;
    f.transported[i].set(u, f.rho[i], f.m[i] / f.rho[i], x);
    const int body = f.body[i];
    const Vec<double, Dim> rigid = f.drift[body] + times_arm(f.spin[body], f.x[i] - f.centre[body]);
    const Vec<double, Dim> relative_velocity = u - rigid;
    return dot(relative_velocity, relative_velocity);
  });
}

/// Advances ρ, s and x with ∇û and û. [Khayyer2024] Eq. 8, 13, 27, 29
template <const UlCauchyFormulation& M, int Dim>
void rate_pass(const UlCauchyFields<Dim>& f, const UlCauchyConstants& c, double dt, const Threads& threads) {
  using K = Kernel<M.kernel>;
  const KernelScale<M, Dim> scale(c.h);
  parallel_pass(f.size, threads, [&](int i) {
    const Motion<Dim> a = spread_motion(f.transported[i]);
    [[maybe_unused]] Sym<Pack, Dim> moment{};
    [[maybe_unused]] Pack compression{};
    Mat<Pack, Dim> gradient{};
    for (int b = f.begin[i]; b < f.begin[i + 1]; ++b) {
      const Motion<Dim> o = gather_motion(f.transported, f.pack(b));
      const Vec<Pack, Dim> d = a.x - o.x, v_ij = a.v - o.v;
      const Pack dw_per_q = K::dw_per_q(Pack(scale.per_h * root(dot(d, d))));
      if constexpr (M.corrected) add_gradient_moment(moment, o.V, dw_per_q, one, d);
      add_velocity_gradient(gradient, o.V, dw_per_q, v_ij, d);
      // [TranDuc2023] §2.2
      if constexpr (M.continuity == Continuity::masses) compression += o.rho * o.V * dw_per_q * dot(v_ij, d);
    }
    Mat<double, Dim> L = scale.of_gradient * sum(gradient);
    if constexpr (M.corrected) L = product(L, gradient_correction(scale.of_gradient * sum(moment)));
    double drho = scale.of_gradient * sum(compression);
    if constexpr (M.continuity == Continuity::velocity_gradient) drho = -a.rho[0] * trace(L);
    f.rho[i] += dt * (drho + f.drho[i]);
    f.s[i] = turned_stress<M.deviator>(L, f.s[i], f.material_of(i).G, dt);
    for (int k = 0; k < Dim; ++k) f.x[i][k] += dt * f.transported[i].c[k];
    f.motion[i].set(f.v[i], f.rho[i], f.m[i] / f.rho[i], f.x[i]);
  });
}

}  // namespace taut
