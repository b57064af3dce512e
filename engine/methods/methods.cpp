#include <algorithm>
#include <array>

#include "engine/method_info.hpp"
#include "engine/methods/all.hpp"
#include "engine/methods/methods_total_lagrangian.hpp"

namespace taut {
namespace {

std::vector<std::string_view> bonded_terms() {
  return {
      "energy             E = Σ_i V_i [ G Σ_j w_ij φ(r_ij/r0_ij) + U(det F_i) ]       terms/bond.hpp",
      "bond force         f_i = Σ_j κ_ij φ′(λ_ij) e_ji                              from [Zhang2024] Eq. 20",
      "pressure force     f_i = Σ_j (V_i P_i g_ij − V_j P_j g_ji), P = U′(J) cof F     terms/bond.hpp",
      "contact            f = K dp^(d−2) (dp − r) between bodies                     "
      "terms/penalty_contact.hpp",
      "stress shown       neo-Hookean stress of F                                    terms/bond.hpp",
      "time               position Verlet, one step                                  [Zhang2024] Eq. 22–25",
  };
}

std::vector<std::string_view> cauchy_terms(const Formulation& m) {
  const bool khayyer = m.pair_stress == PairStress::product;
  std::vector<std::string_view> t;
  if (khayyer) {
    t.push_back(
        "pressure           p = c0² (ρ − ρ0)                                      [Khayyer2024] Eq. 5");
    t.push_back(m.corrected ? "stress divergence  dv/dt = Σ m_j (σ_i·L_i + σ_j·L_j)/(ρ_i ρ_j)·∇W    "
                              "[Khayyer2024] Eq. 28"
                            : "stress divergence  dv/dt = Σ m_j (σ_i + σ_j)/(ρ_i ρ_j)·∇W            "
                              "[Khayyer2024] Eq. 9");
    t.push_back("transport velocity û = u + ε Σ 2 m_j/(ρ_i + ρ_j) (u_j − u_i) W        [Khayyer2024] Eq. 14");
  } else {
    t.push_back(
        "pressure           p = K (ρ/ρ0 − 1)                                      [TranDuc2023] §2.4");
    t.push_back(
        "stress divergence  dv/dt = Σ m_j (σ_i/ρ_i² + σ_j/ρ_j²)·∇W             [TranDuc2023] Eq. 2.3");
  }
  t.push_back("stress rate        ds/dt = 2G (D − tr D/3 I) + ω s − s ω  (Jaumann)  [Khayyer2024] Eq. 6");
  if (m.viscosity == Viscosity::artificial)
    t.push_back(
        "viscosity          dv/dt = Σ m_j Π ∇W                                   [Khayyer2024] Eq. 15, 16");
  if (m.viscosity == Viscosity::riemann)
    t.push_back(
        "Riemann term       dv/dt = −Σ m_j p**/(ρ_i ρ_j) ∇W, second order      [Khayyer2024] Eq. 39–45");
  if (m.density_diffusion)
    t.push_back(
        "density diffusion  dρ/dt = δ h c0 Σ ψ_ij (r·∇W)/r² V_j                [Khayyer2024] Eq. 32–35");
  if (m.artificial_stress)
    t.push_back(m.tensile_control
                    ? "artificial stress  of the surface and its vicinity                       "
                      "[Khayyer2024] Eq. 17–21, 31"
                    : "artificial stress  dv/dt = ε Σ m_j (R_i + R_j) (W/W(dp))ⁿ·∇W          "
                      "[Khayyer2024] Eq. 17–21, 31");
  if (m.tensile_control)
    t.push_back(
        "tensile control    dv/dt = Σ m_j 2 R_i·L_i/(ρ_i ρ_j)·∇W inside        [Khayyer2024] Eq. 49–52");
  t.push_back(
      "time               symplectic Euler, rates at the middle of the step    [Khayyer2024] Eq. 22–26");
  return t;
}

std::vector<std::string_view> terms(const Formulation& m) {
  if (m.shear == Shear::cauchy_stress) return cauchy_terms(m);
  if (m.shear == Shear::bonds) return bonded_terms();
  if (m.shear == Shear::reference_stress) return total_lagrangian_terms(m);
  std::vector<std::string_view> t{
      "pressure           p = c0² (ρ − ρ0)                                       [Zhang2024] Eq. 4",
      "continuity         dρ/dt = ρ_i Σ V_j v_ij·∇W                              [Zhang2024] Eq. 11",
      "pressure force     dv/dt = −2 Σ m_j P*/(ρ_i ρ_j) ∇W, P* of a Riemann problem [Zhang2024] Eq. 12",
  };
  switch (m.shear) {
    case Shear::nested_stress:
      t.push_back(
          "velocity gradient  L = −Σ V_j v_ij ⊗ ∇W                                    [Zhang2024] Eq. 14");
      t.push_back(
          "stress rate        ds/dt = 2G (D − tr D/d I) + ω s − s ω  (Jaumann)        [Zhang2024] Eq. 7");
      t.push_back(
          "shear force        dv/dt = Σ m_j (s_i + s_j)/(ρ_i ρ_j)·∇W                  [Zhang2024] Eq. 13");
      break;
    case Shear::bonds:
    case Shear::cauchy_stress:
    case Shear::reference_stress:
      break;
    case Shear::laplacian_velocity:
      t.push_back(
          "shear force        dv/dt = ∫ 2ζ G/ρ Σ V_j (e·v_ij)/r ∇W dt                 [Zhang2024] Eq. 20");
      break;
    case Shear::laplacian_velocity_nonconservative:
      t.push_back(
          "shear force        dv/dt = ∫ 2 G/ρ Σ V_j v_ij/r ∂W/∂r dt                   [Zhang2024] Eq. 18");
      break;
  }
  if (m.artificial_stress)
    t.push_back(
        "artificial stress  dv/dt = Σ m_j (R_i + R_j) (W/W(dp))ⁿ·∇W, R = −ε σ⁺/ρ²    Gray et al. 2001");
  if (!carries_stress(m))
    t.push_back(
        "stress shown       s = ∫ 2G dev D + rotation dt, corrected gradient        [Zhang2024] Eq. 26–27");
  t.push_back(
      "time               position Verlet, dual-criteria steps                    [Zhang2024] Eq. 21–25");
  return t;
}

std::vector<MethodConstant> cauchy_constants(const Formulation& m) {
  std::vector<MethodConstant> c{{"h", m.h_over_dp, 0.8, 3.0, "smoothing length over the spacing"}};
  if (m.viscosity == Viscosity::artificial)
    c.push_back({"alpha", 1.0, 0.0, 10.0, "α of the artificial viscosity"});
  if (m.viscosity == Viscosity::riemann)
    c.push_back(
        {"riemann_factor", 1.0, 0.0, 2.0, "dissipation over that of Eq. 39; Eq. 43 prints 2, CFL ≤ 0.5"});
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

std::vector<MethodConstant> constants(const Formulation& m) {
  if (m.shear == Shear::cauchy_stress) return cauchy_constants(m);
  if (m.shear == Shear::reference_stress) return total_lagrangian_constants(m);
  if (m.shear == Shear::bonds) return {{"h", m.h_over_dp, 0.8, 3.0, "smoothing length over the spacing"}};
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

/// Those that every method has.
std::vector<MethodConstant> with_contact(std::vector<MethodConstant> c, const Formulation& m) {
  c.push_back({"contact_stiffness", m.contact_stiffness, 0.01, 100.0,
               "stiffness of a penalty contact over K1 K2/(K1 + K2): 1 as published, 2 as the material"});
  return c;
}

/// Bonds act between neighbours of the start, not on what comes near.
std::vector<ContactLaw> contact_laws(const Formulation& m) {
  if (m.shear == Shear::bonds || m.shear == Shear::reference_stress)
    return {ContactLaw::penalty, ContactLaw::impulse};
  return {ContactLaw::sph, ContactLaw::impulse, ContactLaw::penalty};
}

MethodInfo info(const Formulation& m) {
  return {
      .name = m.name,
      .paper = m.paper,
      .summary = m.summary,
      .material_law = m.deviator == Deviator::in_plane ? "2d_deviator" : "neo_hookean",
      .conserves = m.conserves,
      .terms = terms(m),
      .constants = with_contact(constants(m), m),
      .cfl = m.cfl,
      .contact = m.contact,
      .contact_laws = contact_laws(m),
      .several_materials = m.several_materials,
  };
}

template <const Formulation&... M>
auto table(MethodList<M...>) {
  return std::array{info(M)...};
}

}  // namespace

std::span<const MethodInfo> methods() {
  static const auto all = table(Methods{});
  return all;
}

const MethodInfo* find_method(std::string_view name) {
  const auto all = methods();
  const auto it = std::find_if(all.begin(), all.end(), [&](const MethodInfo& m) { return m.name == name; });
  return it == all.end() ? nullptr : &*it;
}

}  // namespace taut
