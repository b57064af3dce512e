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

/// What a pass needs to know of the kernel, worked out once.
template <const Formulation& M, int Dim>
struct KernelScale {
  using K = Kernel<M.kernel>;
  double per_h, alpha_W, alpha_dW, far2;

  explicit KernelScale(double h)
      : per_h(1 / h),
        alpha_W(K::alpha(Dim) / power<Dim>(h)),
        alpha_dW(K::alpha(Dim) / power<Dim + 1>(h)),
        far2(power<2>(2 * K::support * h)) {}

  /// Four pairs (i, j) with x_i − x_j = d. The filling and coincident particles are out of reach.
  CauchyPair<Dim> pair(const Vec<Pack, Dim>& d) const {
    const Pack r2 = dot(d, d);
    CauchyPair<Dim> pair;
    pair.r = root(r2 == 0 ? filled<Pack>(far2) : r2);
    pair.e = Pack(1 / pair.r) * d;
    pair.dW = alpha_dW * K::dw(Pack(per_h * pair.r));
    return pair;
  }
  template <class T>
  T W(const T& r) const {
    return alpha_W * K::w(T(per_h * r));
  }
};

/// ∇u, ∇ρ, the colour function and L_i of every particle, and the geometry that the step works on.
/// `use(i, gradients)` receives those of particle i.
template <const Formulation& M, int Dim, class Use>
void gradient_pass(CauchyFields<M, Dim>& f, const Constants& c, int threads, const Use& use) {
  const KernelScale<M, Dim> kernel(c.h);
  parallel_for(f.size(), threads, [&](int i) TAUT_FLATTEN {
    const Motion<Dim> a = spread_motion(f.motion[i]);
    Sym<Pack, Dim> moment{};
    [[maybe_unused]] Mat<Pack, Dim> L{};
    [[maybe_unused]] Vec<Pack, Dim> grad_rho{};
    [[maybe_unused]] Pack colour{};
    for (int b = f.near.begin[i]; b < f.near.begin[i + 1]; ++b) {
      const Motion<Dim> o = gather_motion(f.motion, f.near.pack(b));
      const CauchyPair<Dim> g = f.pairs[b] = kernel.pair(a.x - o.x);
      const Pack W = kernel.W(g.r);
      if constexpr (needs_kernel(M)) f.W[b].value = W;
      if constexpr (M.corrected) add_gradient_moment(moment, o.V, g.dW, g.r, g.e);
      if constexpr (M.viscosity == Viscosity::riemann) add_velocity_gradient(L, o.V, g.dW, a.v - o.v, g.e);
      if constexpr (M.density_diffusion)
        grad_rho += density_gradient_term(a.rho, o.rho, Pack(f.same_material(b) * o.V), g.dW, g.e);
      if constexpr (M.tensile_control) colour += colour_term(W, o.V);
    }
    Gradients<Dim> result;
    if constexpr (M.corrected) result.L = gradient_correction(sum(moment));
    if constexpr (M.viscosity == Viscosity::riemann) result.D = symmetric_part(product(sum(L), result.L));
    if constexpr (M.density_diffusion) result.grad_rho = result.L * sum(grad_rho);
    if constexpr (M.tensile_control)
      result.colour = sum(colour) + colour_term(kernel.W(0.0), sum(a.V) / lanes);
    use(i, result);
  });
}

/// (W/W(dp))ⁿ; n is whole in every published method, and then products do.
inline Pack closeness(const Pack& W_over_W_dp, double n) {
  const auto whole = static_cast<unsigned>(n);
  Pack result = filled<Pack>(1), square = W_over_W_dp;
  for (unsigned bits = whole; bits != 0; bits >>= 1) {
    if (bits & 1) result *= square;
    square *= square;
  }
  if (n != whole)
    for (int lane = 0; lane < lanes; ++lane) result[lane] *= std::pow(W_over_W_dp[lane], n - whole);
  return result;
}

/// dv/dt and the diffusion of density of every particle: `use(i, a, drho)` receives them, m/s² and kg/(m³ s).
/// Returns the greatest value of `use`.
template <const Formulation& M, int Dim, class Use>
double stress_pass(const CauchyFields<M, Dim>& f, const Constants& c, int threads, const Use& use) {
  using Row = StressRow<M, Dim>;
  [[maybe_unused]] const double per_W_dp = 1 / KernelScale<M, Dim>(c.h).W(c.dp);
  return parallel_max(f.size(), threads, [&](int i) TAUT_FLATTEN {
    const typename Row::Values a = Row::spread(f.stress[i]);
    Vec<Pack, Dim> force{};
    [[maybe_unused]] Vec<Pack, Dim> repulsion{}, sum_gradient{};
    [[maybe_unused]] Pack diffusion{}, surface_neighbors{};
    for (int b = f.near.begin[i]; b < f.near.begin[i + 1]; ++b) {
      const typename Row::Values o = Row::gather(f.stress, f.near.pack(b));
      const CauchyPair<Dim>& g = f.pairs[b];
      const Pack weight = M.pair_stress == PairStress::squares ? Pack(o.rho() * o.V()) : o.V();
      force += stress_divergence_term(a.T(), o.T(), weight, g.dW, g.e);
      if constexpr (M.artificial_stress) {
        const Pack close = closeness(Pack(per_W_dp * f.W[b].value), c.exponent);
        repulsion += stress_divergence_term(a.R(), o.R(), Pack(close * weight), g.dW, g.e);
      }
      const Pack closing_speed = -dot(a.v() - o.v(), g.e);
      if constexpr (M.viscosity == Viscosity::artificial) {
        const Pack Pi = artificial_viscosity(closing_speed, g.r, Pack(0.5 * (a.c() + o.c())),
                                             Pack(0.5 * (a.rho() + o.rho())), c.alpha, c.h);
        const Pack unit = M.pair_stress == PairStress::squares ? filled<Pack>(1) : a.rho();
        force += Pack(unit * o.rho() * o.V() * Pi * g.dW) * g.e;
      }
      if constexpr (M.viscosity == Viscosity::riemann) {
        const Pack speed = reconstructed_closing_speed(closing_speed, a.D(), o.D(), g.r, g.e);
        const Pack p = riemann_dissipation(speed, a.impedance(), o.impedance(), a.root_rho(), o.root_rho());
        force -= Pack(c.riemann_factor * p * o.V() * g.dW) * g.e;
      }
      if constexpr (M.tensile_control) {
        sum_gradient += Pack(o.V() * g.dW) * g.e;
        surface_neighbors += g.r < c.vicinity * c.dp ? o.surface() : Pack{};
      }
      if constexpr (M.density_diffusion)
        diffusion += f.same_material(b) * density_diffusion_term(a.rho(), o.rho(), a.grad_rho(), o.grad_rho(),
                                                                 o.V(), g.dW, g.r, g.e);
    }
    Vec<double, Dim> total = sum(force);
    if constexpr (M.tensile_control) {
      if (a.surface()[0] == 0 && sum(surface_neighbors) == 0)
        total += tensile_control(Row::R(f.stress[i]), sum(sum_gradient));
      else
        total += (c.surface_artificial_stress * c.epsilon) * sum(repulsion);
    } else if constexpr (M.artificial_stress) {
      total += c.epsilon * sum(repulsion);
    }
    if constexpr (M.pair_stress == PairStress::product) total = (1 / a.rho()[0]) * total;
    return use(i, total, M.density_diffusion ? c.delta * c.h * c.c0 * sum(diffusion) : 0.0);
  });
}

/// û of every particle, from the new velocities. `use(i, du)` receives û_i − u_i, m/s, and returns a number
/// of which the greatest is returned.                                                [Khayyer2024] Eq. 14
template <const Formulation& M, int Dim, class Use>
double transport_pass(const CauchyFields<M, Dim>& f, const Constants& c, int threads, const Use& use) {
  return parallel_max(f.size(), threads, [&](int i) TAUT_FLATTEN {
    const Motion<Dim> a = spread_motion(f.moved[i]);
    Vec<Pack, Dim> du{};
    for (int b = f.near.begin[i]; b < f.near.begin[i + 1]; ++b) {
      const Motion<Dim> o = gather_motion_only(f.moved, f.near.pack(b));
      du += xsph_term(a.v - o.v, a.rho, o.rho, o.V, f.W[b].value);
    }
    return use(i, c.xsph * sum(du));
  });
}

/// ∇û of every particle and, where it is not −ρ tr ∇û, the rate of density: `use(i, L, drho)` receives them,
/// 1/s and kg/(m³ s). The geometry is that of `transported`.     [Khayyer2024] Eq. 8, 13, 27, 29
template <const Formulation& M, int Dim, class Use>
void rate_pass(const CauchyFields<M, Dim>& f, const Constants& c, int threads, const Use& use) {
  const KernelScale<M, Dim> kernel(c.h);
  parallel_for(f.size(), threads, [&](int i) TAUT_FLATTEN {
    const Motion<Dim> a = spread_motion(f.transported[i]);
    [[maybe_unused]] Sym<Pack, Dim> moment{};
    [[maybe_unused]] Pack compression{};
    Mat<Pack, Dim> gradient{};
    for (int b = f.near.begin[i]; b < f.near.begin[i + 1]; ++b) {
      const Motion<Dim> o = gather_motion(f.transported, f.near.pack(b));
      const CauchyPair<Dim> g = kernel.pair(a.x - o.x);
      const Vec<Pack, Dim> v_ij = a.v - o.v;
      if constexpr (M.corrected) add_gradient_moment(moment, o.V, g.dW, g.r, g.e);
      add_velocity_gradient(gradient, o.V, g.dW, v_ij, g.e);
      // Σ m_j u_ij·∇W, [TranDuc2023] §2.2
      if constexpr (M.continuity == Continuity::masses) compression += o.rho * o.V * g.dW * dot(v_ij, g.e);
    }
    Mat<double, Dim> L = sum(gradient);
    if constexpr (M.corrected) L = product(L, gradient_correction(sum(moment)));
    double drho = sum(compression);
    if constexpr (M.continuity == Continuity::velocity_gradient) drho = -a.rho[0] * trace(L);
    use(i, L, drho);
  });
}

}  // namespace taut::inline TAUT_ISA
