#include "engine/families/describe.hpp"

namespace taut {
namespace {

void add_stress_divergence(std::vector<TermInfo>& t, const Formulation& m) {
  constexpr std::string_view function = "terms/stress_divergence.hpp:stress_divergence_term";
  constexpr std::string_view test =
      "stress divergence: equal and opposite, and the pull of tension is towards the other";
  if (m.pair_stress == PairStress::squares)
    t.push_back({"stress divergence", "dv/dt = Σ m_j (σ_i/ρ_i² + σ_j/ρ_j²)·∇W", "[TranDuc2023] Eq. 2.3",
                 function, test});
  else if (m.corrected)
    t.push_back({"stress divergence", "dv/dt = Σ m_j (σ_i·L_i + σ_j·L_j)/(ρ_i ρ_j)·∇W",
                 "[Khayyer2024] Eq. 28", function, test});
  else
    t.push_back({"stress divergence", "dv/dt = Σ m_j (σ_i + σ_j)/(ρ_i ρ_j)·∇W", "[Khayyer2024] Eq. 9",
                 function, test});
}

void add_kinematics(std::vector<TermInfo>& t, const Formulation& m) {
  const bool khayyer = m.pair_stress == PairStress::product;
  t.push_back({"pressure", "p = c0² (ρ − ρ0)", khayyer ? "[Khayyer2024] Eq. 5" : "[TranDuc2023] §2.4",
               "terms/equation_of_state.hpp:pressure",
               "equation of state: positive in compression, with slope c0²"});
  if (m.corrected)
    t.push_back({"gradient correction", "L = (−Σ V_j r_ij ⊗ ∇W)⁻¹", "[Khayyer2024] §3.1",
                 "terms/gradient_correction.hpp:gradient_correction",
                 "gradient correction: exact for a linear field at a surface, and far off without"});
  if (m.transport_velocity)
    t.push_back({"transport velocity", "û = u + ε Σ 2 m_j/(ρ_i + ρ_j) (u_j − u_i) W", "[Khayyer2024] Eq. 14",
                 "terms/xsph.hpp:xsph_term",
                 "xsph: momentum stays, and so does angular momentum, of the transported motion"});
  const std::string_view source = !khayyer      ? "[TranDuc2023] §2.2"
                                  : m.corrected ? "[Khayyer2024] Eq. 27, 29"
                                                : "[Khayyer2024] Eq. 8, 13";
  const std::string_view formula = !khayyer      ? "∇u = Σ V_j u_ji ⊗ ∇W, dρ/dt = Σ m_j u_ij·∇W"
                                   : m.corrected ? "∇û = Σ V_j û_ji ⊗ L_i·∇W, dρ/dt = −ρ tr ∇û"
                                                 : "∇û = Σ V_j û_ji ⊗ ∇W, dρ/dt = −ρ tr ∇û";
  t.push_back({"velocity gradient", formula, source, "terms/velocity_gradient.hpp:add_velocity_gradient",
               "velocity gradient: exact for a linear field after correction, on irregular particles"});
  t.push_back({"stress rate", "ds/dt = 2G (D − tr D/3 I) + ω s − s ω",
               khayyer ? "[Khayyer2024] Eq. 6, 7" : "[TranDuc2023] Eq. 2.4",
               "terms/stress_rate.hpp:turned_stress",
               "turned stress: a rigid turn of any size in one step turns it and keeps its size"});
}

void add_dissipation(std::vector<TermInfo>& t, const Formulation& m) {
  const bool khayyer = m.pair_stress == PairStress::product;
  if (m.viscosity == Viscosity::artificial)
    t.push_back({"artificial viscosity", "dv/dt = Σ m_j Π ∇W, Π = α h c̄/ρ̄ u·r/(r² + 0.01 h²) where it closes",
                 khayyer ? "[Khayyer2024] Eq. 15, 16" : "[TranDuc2023] §2.2",
                 "terms/artificial_viscosity.hpp:artificial_viscosity",
                 "artificial viscosity: slows what closes by Eq. 16, leaves what opens"});
  if (m.viscosity == Viscosity::riemann)
    t.push_back({"Riemann term", "dv/dt = −Σ m_j p**/(ρ_i ρ_j) ∇W, p** = C_ij (u_i − u_j) reconstructed",
                 "[Khayyer2024] Eq. 39–45", "terms/riemann_second_order.hpp:riemann_dissipation",
                 "Riemann term: none where the velocity is linear, equal and opposite"});
  if (m.density_diffusion)
    t.push_back({"density diffusion", "dρ/dt = δ h c0 Σ ψ_ij (r·∇W)/r² V_j", "[Khayyer2024] Eq. 32–35",
                 "terms/density_diffusion.hpp:density_diffusion_term",
                 "density diffusion: none where the density is linear, from dense to thin otherwise"});
}

void add_tension(std::vector<TermInfo>& t, const Formulation& m) {
  const bool khayyer = m.pair_stress == PairStress::product;
  if (m.artificial_stress)
    t.push_back({m.tensile_control ? "artificial stress, at surfaces" : "artificial stress",
                 "dv/dt = ε Σ (W/W(dp))ⁿ of the stress divergence of −σ⁺",
                 !khayyer      ? "[TranDuc2023] §2.2"
                 : m.corrected ? "[Khayyer2024] Eq. 18–21, 31"
                               : "[Khayyer2024] Eq. 17–21",
                 "terms/artificial_stress.hpp:positive_part",
                 "artificial stress: the positive part against principal stresses chosen by hand"});
  if (!m.tensile_control) return;
  t.push_back({"tensile control, inside", "dv/dt = Σ m_j 2 R_i·L_i/(ρ_i ρ_j)·∇W, R = −σ⁺",
               "[Khayyer2024] Eq. 49–51", "terms/tensile_instability_control.hpp:tensile_control",
               "tensile control: turns the sum of equal tensions into their difference"});
  t.push_back({"surface", "C = Σ W V_j < 0.9, and what is nearer than 1.2 dp", "[Khayyer2024] Eq. 52",
               "terms/tensile_instability_control.hpp:colour_term",
               "colour function: 1 inside a lattice, below 0.9 on its face, above one row deeper"});
}

}  // namespace

std::vector<TermInfo> cauchy_stress_terms(const Formulation& m) {
  const bool khayyer = m.pair_stress == PairStress::product;
  std::vector<TermInfo> t;
  add_kinematics(t, m);
  add_stress_divergence(t, m);
  add_dissipation(t, m);
  add_tension(t, m);
  t.push_back(khayyer ? impulse_term() : penalty_term());
  t.push_back({"time", "symplectic Euler, rates at the middle of the step or where `geometry` says",
               khayyer ? "[Khayyer2024] Eq. 22–26" : "none stated: that of [Khayyer2024]",
               "families/ul_cauchy/solver.hpp:step",
               khayyer ? "naive: the ladder, a clamped plate of two materials and a disc that hits it"
                       : "naive: the current configuration, a clamped plate of two materials and a disc that "
                         "hits it"});
  return t;
}

std::vector<MethodConstant> cauchy_stress_constants(const Formulation& m) {
  std::vector<MethodConstant> c{{"h", m.h_over_dp, 0.8, 3.0, "smoothing length over the spacing"}};
  if (m.viscosity == Viscosity::artificial)
    c.push_back({"alpha", 1.0, 0.0, 10.0, "α of the artificial viscosity"});
  if (m.viscosity == Viscosity::riemann)
    c.push_back(
        {"riemann_factor", 1.0, 0.0, 2.0, "dissipation over that of Eq. 39; Eq. 43 prints 2, CFL ≤ 0.5"});
  c.push_back(
      {"geometry", 0.5, 0.0, 1.0, "where in the step ∇u is taken: 0 its start, as printed, 1 its end"});
  if (m.transport_velocity) c.push_back({"xsph", 0.5, 0.0, 1.0, "ε of the transport velocity"});
  if (m.density_diffusion) c.push_back({"delta", 0.002, 0.0, 0.1, "δ of the density diffusion"});
  if (m.artificial_stress) {
    const bool khayyer = m.pair_stress == PairStress::product;
    c.push_back({"epsilon", khayyer ? 0.15 : 0.3, 0.0, 10.0, "ε of the artificial stress"});
    c.push_back({"exponent", khayyer ? 8.0 : 6.0, 0.0, 20.0, "n of the artificial stress"});
  }
  if (m.tensile_control) {
    c.push_back(
        {"surface_colour", 0.9, 0.0, 1.2, "colour function below which a particle is of the surface"});
    c.push_back({"vicinity", 1.2, 0.0, 3.0, "reach of the surface in spacings"});
    c.push_back({"surface_artificial_stress", 1.0, 0.0, 1.0, "share of the artificial stress at surfaces"});
  }
  return c;
}

}  // namespace taut
