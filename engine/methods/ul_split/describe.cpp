#include "engine/methods/ul_split/describe.hpp"

#include "engine/methods/ul_split/passes.hpp"

namespace taut::ul_split {
namespace {

constexpr TermInfo time_info{"time", "position Verlet, dual-criteria steps", "[Zhang2024] Eq. 21–25",
                             "methods/ul_split/solver.cpp:step",
                             "naive: a colliding ring and disc follow the transcription with dual stepping"};

}  // namespace

std::vector<TermInfo> terms(const UlSplitFormulation& m) {
  std::vector<TermInfo> t{equation_of_state_info, compression_info, riemann_pressure_info};
  if (has_penalty(m))
    t.insert(t.end(), {penalized_gradient_info, jaumann_rate_info, nested_shear_info,
                       m.central_penalty ? central_velocity_penalty_info : velocity_penalty_info});
  else if (carries_stress(m))
    t.insert(t.end(), {velocity_gradient_info, jaumann_rate_info, nested_shear_info});
  if (m.shear == Shear::laplacian_velocity) t.push_back(laplacian_info);
  if (m.shear == Shear::laplacian_velocity_nonconservative) t.push_back(laplacian_nonconservative_info);
  if (m.artificial_stress) t.push_back(artificial_stress_info);
  if (!carries_stress(m)) t.push_back(stress_recovery_info);
  t.push_back(time_info);
  return t;
}

std::vector<ConstantRow<UlSplitConstants>> constants(const UlSplitFormulation& m, int dim) {
  using C = UlSplitConstants;
  std::vector<ConstantRow<UlSplitConstants>> c{
      {&C::h, {"h", m.h_over_dp, 0.8, 3.0, "smoothing length over the spacing", true, true}},
      {&C::beta_least,
       {"beta_least", m.beta_least, 0.0, 1.0,
        "lower bound of β, the factor of the dissipation in P*: 1 without limiter, 0 with the full limiter"}},
      {&C::riemann_limiter,
       {"riemann_limiter", 3.0, 0.0, 1000.0, "β = min(max(limiter · closing speed/c0, beta_least), 1)"}},
      {&C::pressure_diffusion,
       {"pressure_diffusion", 0.0, 0.0, 1.0,
        "share of (p_i − p_j)/(2 ρ0 c0) in U*: 1 as in a linearised Riemann solver, "
        "0 leaves it out, as the authors' program does"}},
      {&C::cfl_advection,
       {"cfl_advection", m.cfl_advection, 1e-3, 1.0,
        "distance between rebuilds, in h; for dual stepping (Eq. 21)"}},
      {&C::cubic_spline,
       switch_constant("cubic_spline", 0, "kernel: 0 Wendland C2 as published, 1 cubic B-spline")},
  };
  if (m.shear == Shear::laplacian_velocity)
    c.push_back({&C::zeta,
                 {"zeta", 0.7 * dim + 2.1, 0.0, 100.0,
                  "ζ of the Laplacian: 0.7 d + 2.1 calibrated, d + 2 consistent"}});
  if (has_penalty(m))
    c.push_back({&C::xi,
                 {"xi", m.central_penalty ? 2.0 : 4.0, 0.0, 20.0,
                  "factor ξ of the penalty on velocity differences that the velocity gradients miss"}});
  if (m.central_penalty)
    c.push_back(
        {&C::penalty_rotation,
         switch_constant("penalty_rotation", 0,
                         "1 rotates the accumulated penalty with the spin, as the first public version does; "
                         "linear momentum then changes")});
  if (m.artificial_stress) {
    c.push_back({&C::epsilon, {"epsilon", m.epsilon, 0.0, 10.0, "ε of the artificial stress"}});
    c.push_back({&C::exponent, {"exponent", m.exponent, 0.0, 20.0, "n of the artificial stress"}});
  }
  return c;
}

}  // namespace taut::ul_split
