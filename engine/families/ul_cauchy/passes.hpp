#pragma once

#include <cmath>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/families/ul_cauchy/rows.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/terms/artificial_viscosity.hpp"
#include "engine/terms/density_diffusion.hpp"
#include "engine/terms/gradient_correction.hpp"
#include "engine/terms/riemann_second_order.hpp"
#include "engine/terms/stress_divergence.hpp"
#include "engine/terms/tensile_instability_control.hpp"
#include "engine/terms/velocity_gradient.hpp"
#include "engine/terms/xsph.hpp"

/// The loops over neighbours of the methods whose Cauchy stress acts as a whole. All of them gather over i,
/// so that no result depends on the number of threads.
namespace taut::inline TAUT_ISA {

/// Geometry of four pairs (i, j) at the start of the step. The filling has w′/q = 0 and an r beyond the support.
template <int Dim>
struct CauchyPair {
  Vec<Pack, Dim> d;  // x_i − x_j, m
  Pack r;            // m
  Pack dw_per_q;     // w′(q)/q of kernels/kernel.hpp
};

/// The scales of W and ∇W, worked out once. The terms are written in ∂W/∂r, r and e_ij. The passes have
/// ∇_i W = α/h^(Dim+2) w′/q (x_i − x_j) without a quotient: they hand the terms w′/q for ∂W/∂r, x_i − x_j for
/// e_ij and `one` for r, and scale their sums.
template <const Formulation& M, int Dim>
struct KernelScale {
  using K = Kernel<M.kernel>;
  double per_h, of_W, of_gradient, beyond2;

  explicit KernelScale(double h)
      : per_h(1 / h),
        of_W(K::alpha(Dim) / power<Dim>(h)),
        of_gradient(K::alpha(Dim) / power<Dim + 2>(h)),
        beyond2(power<2>(2 * K::support * h)) {}

  /// Worked out again by each pass: what all pairs would keep comes no sooner from memory.
  CauchyPair<Dim> pair(const Vec<Pack, Dim>& d) const {
    const Pack r2 = dot(d, d);
    const Pack r = root(r2 == 0 ? filled<Pack>(beyond2) : r2);  // the filling and coincident particles
    return {d, r, K::dw_per_q(Pack(per_h * r))};
  }
};

/// ∇u, ∇ρ, the colour function and L_i of every particle, and the W of pairs that the step works on.
/// `use(i, gradients)` receives those of particle i.
template <const Formulation& M, int Dim, class Use>
void gradient_pass(CauchyFields<M, Dim>& f, const Constants& c, int threads, const Use& use) {
  using K = Kernel<M.kernel>;
  const KernelScale<M, Dim> scale(c.h);
  parallel_pass(f.size(), threads, [&](int i) {
    const Motion<Dim> a = spread_motion(f.motion[i]);
    Sym<Pack, Dim> moment{};
    [[maybe_unused]] Mat<Pack, Dim> L{};
    [[maybe_unused]] Vec<Pack, Dim> grad_rho{};
    [[maybe_unused]] Pack colour{};
    for (int b = f.near.begin[i]; b < f.near.begin[i + 1]; ++b) {
      const Motion<Dim> o = gather_motion(f.motion, f.near.pack(b));
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
    if constexpr (M.density_diffusion) result.grad_rho = result.L * (scale.of_gradient * sum(grad_rho));
    if constexpr (M.tensile_control)
      result.colour = scale.of_W * (sum(colour) + colour_term(K::w(0.0), a.V[0]));
    use(i, result);
  });
}

/// Σ_j of the artificial stress of particle i, in units of ∇W.
template <const Formulation& M, int Dim>
class Repulsion {
 public:
  explicit Repulsion(const Constants& c)
      : scale_(c.h), per_w_dp_(1 / K::w(c.dp / c.h)), exponent_(c.exponent) {}

  /// Of the neighbours in pack `b`, which are `pair` from i and count by `weight`.
  Vec<Pack, Dim> term(const CauchyFields<M, Dim>& f, const Mat<Pack, Dim>& R_i, int b,
                      const CauchyPair<Dim>& pair, const Pack& weight) const {
    const Pack close = power(Pack(per_w_dp_ * f.w[b].value), exponent_);  // (W/W(dp))ⁿ
    const Mat<Pack, Dim> R_j = RepulsionRow<Dim>::gather(f.repulsion, f.near.pack(b));
    return stress_divergence_term(R_i, R_j, Pack(close * weight), pair.dw_per_q, pair.d);
  }
  Vec<double, Dim> of_all(const CauchyFields<M, Dim>& f, int i) const {
    const Mat<Pack, Dim> R_i = spread(f.repulsion[i].get());
    Vec<Pack, Dim> all{};
    for (int b = f.near.begin[i]; b < f.near.begin[i + 1]; ++b)
      all += term(f, R_i, b, scale_.pair(f.apart(i, b)),
                  StressRow<M, Dim>::gather(f.stress, f.near.pack(b)).weight());
    return sum(all);
  }

 private:
  using K = Kernel<M.kernel>;
  KernelScale<M, Dim> scale_;
  double per_w_dp_, exponent_;
};

/// dv/dt and the diffusion of density of every particle: `use(i, a, drho)` receives them, m/s² and kg/(m³ s).
/// Returns the greatest value of `use`.
template <const Formulation& M, int Dim, class Use>
double stress_pass(const CauchyFields<M, Dim>& f, const Constants& c, int threads, const Use& use) {
  using Row = StressRow<M, Dim>;
  const KernelScale<M, Dim> scale(c.h);
  return parallel_max(f.size(), threads, [&, repulsion = Repulsion<M, Dim>(c)](int i) {
    const auto a = Row::spread(f.stress[i]);
    Vec<Pack, Dim> force{};
    constexpr bool everywhere = M.artificial_stress && !M.tensile_control;
    [[maybe_unused]] Mat<Pack, Dim> R_i;
    if constexpr (everywhere) R_i = spread(f.repulsion[i].get());
    [[maybe_unused]] Vec<Pack, Dim> sum_gradient{}, sum_repulsion{};
    [[maybe_unused]] Pack diffusion{}, surface_neighbors{};
    for (int b = f.near.begin[i]; b < f.near.begin[i + 1]; ++b) {
      const auto o = Row::gather(f.stress, f.near.pack(b));
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
        const Pack r_speed = reconstructed_closing_speed(approach, a.D(), o.D(), one, d);
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
    return use(i, scale.of_gradient * total, drho);
  });
}

/// û of every particle, from the new velocities. `use(i, du)` receives û_i − u_i, m/s, and returns a number
/// of which the greatest is returned.                                                [Khayyer2024] Eq. 14
template <const Formulation& M, int Dim, class Use>
double transport_pass(const CauchyFields<M, Dim>& f, const Constants& c, int threads, const Use& use) {
  const double of_W = KernelScale<M, Dim>(c.h).of_W;
  return parallel_max(f.size(), threads, [&](int i) {
    const Motion<Dim> a = spread_motion(f.moved[i]);
    Vec<Pack, Dim> du{};
    for (int b = f.near.begin[i]; b < f.near.begin[i + 1]; ++b) {
      const Motion<Dim> o = gather_motion_only(f.moved, f.near.pack(b));
      du += xsph_term(a.v - o.v, a.rho, o.rho, o.V, f.w[b].value);
    }
    return use(i, (c.xsph * of_W) * sum(du));
  });
}

/// ∇û of every particle and, where it is not −ρ tr ∇û, the rate of density: `use(i, L, drho)` receives them,
/// 1/s and kg/(m³ s). The geometry is that of `transported`.     [Khayyer2024] Eq. 8, 13, 27, 29
template <const Formulation& M, int Dim, class Use>
void rate_pass(const CauchyFields<M, Dim>& f, const Constants& c, int threads, const Use& use) {
  using K = Kernel<M.kernel>;
  const KernelScale<M, Dim> scale(c.h);
  parallel_pass(f.size(), threads, [&](int i) {
    const Motion<Dim> a = spread_motion(f.transported[i]);
    [[maybe_unused]] Sym<Pack, Dim> moment{};
    [[maybe_unused]] Pack compression{};
    Mat<Pack, Dim> gradient{};
    for (int b = f.near.begin[i]; b < f.near.begin[i + 1]; ++b) {
      const Motion<Dim> o = gather_motion(f.transported, f.near.pack(b));
      const Vec<Pack, Dim> d = a.x - o.x, v_ij = a.v - o.v;
      const Pack dw_per_q = K::dw_per_q(Pack(scale.per_h * root(dot(d, d))));
      if constexpr (M.corrected) add_gradient_moment(moment, o.V, dw_per_q, one, d);
      add_velocity_gradient(gradient, o.V, dw_per_q, v_ij, d);
      // Σ m_j u_ij·∇W, [TranDuc2023] §2.2
      if constexpr (M.continuity == Continuity::masses) compression += o.rho * o.V * dw_per_q * dot(v_ij, d);
    }
    Mat<double, Dim> L = scale.of_gradient * sum(gradient);
    if constexpr (M.corrected) L = product(L, gradient_correction(scale.of_gradient * sum(moment)));
    double drho = scale.of_gradient * sum(compression);
    if constexpr (M.continuity == Continuity::velocity_gradient) drho = -a.rho[0] * trace(L);
    use(i, L, drho);
  });
}

}  // namespace taut::inline TAUT_ISA
