#include "engine/families/describe.hpp"

namespace taut {
namespace {

void add_shear(std::vector<TermInfo>& t, const Formulation& m) {
  switch (m.shear) {
    case Shear::nested_stress:
      t.push_back({"velocity gradient", "L = −Σ V_j v_ij ⊗ ∇W", "[Zhang2024] Eq. 14",
                   "terms/velocity_gradient.hpp:add_velocity_gradient",
                   "velocity gradient: exact for a linear field after correction, on irregular particles"});
      t.push_back({"stress rate", "ds/dt = 2G (D − tr D/d I) + ω s − s ω", "[Zhang2024] Eq. 7",
                   "terms/stress_rate.hpp:jaumann_rate",
                   "stress rate: by hand for stretch and shear, for both deviators"});
      t.push_back({"shear force", "dv/dt = Σ m_j (s_i + s_j)/(ρ_i ρ_j)·∇W", "[Zhang2024] Eq. 13",
                   "terms/shear.hpp:nested_shear_term",
                   "force: what j does to i, i does to j in the other direction"});
      break;
    case Shear::laplacian_velocity:
      t.push_back({"shear force", "dv/dt = ∫ 2ζ G/ρ Σ V_j (e·v_ij)/r ∇W dt", "[Zhang2024] Eq. 20",
                   "terms/shear.hpp:laplacian_term",
                   "laplacian: in the continuum it is (∇²v + 2 ∇∇·v)/(d + 2), the plain one ∇²v"});
      break;
    case Shear::laplacian_velocity_nonconservative:
      t.push_back({"shear force", "dv/dt = ∫ 2 G/ρ Σ V_j v_ij/r ∂W/∂r dt", "[Zhang2024] Eq. 18",
                   "terms/shear.hpp:laplacian_term_nonconservative",
                   "laplacian: in the continuum it is (∇²v + 2 ∇∇·v)/(d + 2), the plain one ∇²v"});
      break;
    default:
      break;
  }
}

}  // namespace

std::vector<TermInfo> updated_lagrangian_terms(const Formulation& m) {
  std::vector<TermInfo> t{
      {"pressure", "p = c0² (ρ − ρ0)", "[Zhang2024] Eq. 4", "terms/equation_of_state.hpp:pressure",
       "equation of state: positive in compression, with slope c0²"},
      {"continuity", "dρ/dt = ρ_i Σ V_j v_ij·∇W", "[Zhang2024] Eq. 11", "terms/riemann.hpp:compression_term",
       "riemann: what closes grows denser, whatever the order of the pair"},
      {"pressure force", "dv/dt = −2 Σ m_j P*/(ρ_i ρ_j) ∇W", "[Zhang2024] Eq. 12",
       "terms/riemann.hpp:riemann_pressure", "riemann: P* is symmetric in the two states"},
  };
  add_shear(t, m);
  if (m.artificial_stress)
    t.push_back({"artificial stress", "dv/dt = Σ m_j (R_i + R_j) (W/W(dp))ⁿ·∇W, R = −ε σ⁺/ρ²",
                 "[Zhang2024] §6, Gray et al. 2001", "terms/artificial_stress.hpp:artificial_stress_term",
                 "artificial stress: pushes a stretched pair apart, the more the closer it is"});
  if (!carries_stress(m))
    t.push_back({"stress shown", "s = ∫ 2G dev D + rotation dt, corrected gradient", "[Zhang2024] Eq. 26, 27",
                 "terms/gradient_correction.hpp:add_gradient_moment",
                 "velocity gradient: exact for a linear field after correction, on irregular particles"});
  t.push_back({"time", "position Verlet, dual-criteria steps", "[Zhang2024] Eq. 21–25",
               "families/ul_split/solver.hpp:step", "naive: a ring and a disc that collide, dual stepping"});
  return t;
}

std::vector<MethodConstant> updated_lagrangian_constants(const Formulation& m) {
  std::vector<MethodConstant> c{
      {"h", m.h_over_dp, 0.8, 3.0, "smoothing length over the spacing"},
      {"beta_least", m.beta_least, 0.0, 1.0, "least β of the dissipation in P*: 1 linear, 0 limited"},
      {"riemann_limiter", 3.0, 0.0, 1000.0, "β = min(max(limiter · closing speed/c0, beta_least), 1)"},
      {"pressure_diffusion", 0.0, 0.0, 1.0,
       "share of (p_i − p_j)/(2 ρ0 c0) in U*: 1 as in the paper's solver, 0 without"},
      {"cfl_advection", m.cfl_advection, 1e-3, 1.0, "way over h between rebuilds (Eq. 21)"},
  };
  if (m.shear == Shear::laplacian_velocity)
    c.push_back(
        {"zeta", 0.7 * 2 + 2.1, 0.0, 100.0, "ζ of the Laplacian: 0.7 d + 2.1 calibrated, d + 2 consistent"});
  if (m.artificial_stress) {
    c.push_back({"epsilon", 0.3, 0.0, 10.0, "ε of the artificial stress"});
    c.push_back({"exponent", 4.0, 0.0, 20.0, "n of the artificial stress"});
  }
  return c;
}

}  // namespace taut
