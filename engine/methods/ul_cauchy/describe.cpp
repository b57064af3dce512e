#include "engine/methods/ul_cauchy/describe.hpp"

#include <iterator>

#include "engine/methods/ul_cauchy/passes.hpp"
#include "engine/terms/contact_laws.hpp"

namespace taut::ul_cauchy {
namespace {

constexpr TermInfo time_info{
    "time", "symplectic Euler, ∇û at the positions that `geometry` sets, by default in mid-step",
    "[Khayyer2024] Eq. 22–26", "methods/ul_cauchy/solver.cpp:step",
    "naive: the ladder follows the transcription for a plate of two materials hit by a disc"};

void add_stress(std::vector<TermInfo>& t, const UlCauchyFormulation& m) {
  if (m.pair_stress == PairStress::squares)
    t.push_back(divergence_of_squares_info);
  else
    t.push_back(m.corrected ? corrected_divergence_info : stress_divergence_info);
}

void add_kinematics(std::vector<TermInfo>& t, const UlCauchyFormulation& m) {
  t.push_back(equation_of_state_info);
  if (m.corrected) t.push_back(gradient_correction_info);
  if (m.transport_velocity) t.push_back(xsph_info);
  if (m.continuity == Continuity::masses)
    t.push_back(gradient_and_masses_info);
  else
    t.push_back(m.corrected ? corrected_gradient_info : transported_gradient_info);
  t.push_back(turned_stress_info);
}

void add_dissipation(std::vector<TermInfo>& t, const UlCauchyFormulation& m) {
  if (m.viscosity == Viscosity::artificial) t.push_back(artificial_viscosity_info);
  if (m.viscosity == Viscosity::riemann) t.push_back(riemann_dissipation_info);
  if (m.density_diffusion) t.push_back(density_diffusion_info);
}

void add_tension(std::vector<TermInfo>& t, const UlCauchyFormulation& m) {
  if (m.tensile_control)
    t.insert(t.end(), {surface_repulsion_info, tensile_control_info, surface_info});
  else if (m.artificial_stress)
    t.push_back(m.corrected ? corrected_repulsion_info : repulsion_info);
}

}  // namespace

std::vector<TermInfo> terms(const UlCauchyFormulation& m) {
  std::vector<TermInfo> t;
  add_kinematics(t, m);
  add_stress(t, m);
  add_dissipation(t, m);
  add_tension(t, m);
  t.push_back(contact_info(m.contact));
  t.push_back(time_info);
  return t;
}

std::vector<ConstantRow<UlCauchyConstants>> constants(const UlCauchyFormulation& m, int) {
  using C = UlCauchyConstants;
  std::vector<ConstantRow<UlCauchyConstants>> c{
      {&C::h, {"h", m.h_over_dp, 0.8, 3.0, "smoothing length over the spacing", true, true}}};
  if (m.viscosity == Viscosity::artificial)
    c.push_back({&C::alpha, {"alpha", 1.0, 0.0, 10.0, "α of the artificial viscosity"}});
  if (m.viscosity == Viscosity::riemann) {
    c.push_back({&C::riemann_factor,
                 {"riemann_factor", 1.0, 0.0, 2.0, "factor of the dissipation in Eq. 39; Eq. 43 prints 2"}});
    c.push_back(
        {&C::limiter,
         {.name = "limiter",
          .value = 0,
          .low = 0,
          .high = std::size(limiter_names) - 1.0,
          .help =
              "slope limiter of the Riemann term; first-order: velocities without reconstruction, Eq. 37, B.20",
          .choices = limiter_names}});
  }
  c.push_back({&C::geometry,
               {"geometry", 0.5, 0.0, 1.0,
                "positions at which ∇u is evaluated: 0 start of the step, as printed; 1 end"}});
  if (m.transport_velocity) c.push_back({&C::xsph, {"xsph", 0.5, 0.0, 1.0, "ε of the transport velocity"}});
  if (m.density_diffusion) {
    c.push_back({&C::delta, {"delta", 0.002, 0.0, 0.1, "δ of the density diffusion"}});
    c.push_back({&C::delta_order,
                 {"delta_order", 1.0, 0.0, 1.0,
                  "order of the density diffusion: 1 corrects ψ by ∇ρ, Eq. 34; 0 does not, Eq. B.3"}});
  }
  if (m.artificial_stress) {
    c.push_back({&C::epsilon, {"epsilon", m.epsilon, 0.0, 10.0, "ε of the artificial stress"}});
    c.push_back({&C::exponent, {"exponent", m.exponent, 0.0, 20.0, "n of the artificial stress"}});
    if (chooses_repulsion_weight(m))
      c.push_back(
          {&C::repulsion_weight,
           {.name = "repulsion_weight",
            .value = 0,
            .low = 0,
            .high = std::size(repulsion_weight_names) - 1.0,
            .help = "weight of the artificial stress; kernel: (W/W(dp))ⁿ; distance: (r/dp)ⁿ, as printed",
            .choices = repulsion_weight_names}});
  }
  if (m.tensile_control) {
    c.push_back(
        {&C::surface_colour,
         {"surface_colour", 0.9, 0.0, 1.2, "colour function below which a particle belongs to the surface"}});
    c.push_back({&C::vicinity,
                 {"vicinity", 1.2, 0.0, 3.0,
                  "distance from surface particles within which the artificial stress acts, in spacings"}});
    c.push_back({&C::surface_artificial_stress,
                 {"surface_artificial_stress", 1.0, 0.0, 1.0, "share of the artificial stress at surfaces"}});
  }
  return c;
}

}  // namespace taut::ul_cauchy
