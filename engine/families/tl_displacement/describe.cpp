#include "engine/families/describe.hpp"

namespace taut {
namespace {

TermInfo law_term(Law law) {
  constexpr std::string_view test = "laws: no stress at rest, Hooke's law for small strains";
  switch (law) {
    case Law::neo_hookean:
      return {"stress", "P = G j^(−2/3) F + (K (J − 1) − G/3 j^(−5/3) F:F) cof F, j = det F",
              "[Lee2016] Eq. 8–12", "materials/neo_hookean.hpp:piola", test};
    case Law::st_venant_kirchhoff:
      return {"stress", "P = F (2G dev E + K tr E I), E = ½ (FᵀF − I)", "textbook",
              "materials/st_venant_kirchhoff.hpp:piola", test};
    case Law::linear_elastic:
      return {"stress", "P = 2G dev ε + K tr ε I, ε = ½ (F + Fᵀ) − I", "[Zhang2020] Eq. 3, 4",
              "materials/linear_elastic.hpp:piola", test};
    case Law::rotated_piola:
      return {"stress", "P = R (2G dev E + K tr E I), F = R U, E = ½ (FᵀF − I)", "[TranDuc2023] §2.3",
              "materials/rotated_piola.hpp:piola", test};
    case Law::none:
      break;
  }
  return {};
}

constexpr std::string_view exact_gradients =
    "pairs of the start: antisymmetric, within a body, gradients of linear fields exact";
constexpr std::string_view internal_force = "f_i = Σ_j (V_i P_i B_i + V_j P_j B_j) k_ij";
constexpr std::string_view exact_force =
    "pairs of the start: the force is minus the derivative of the energy";

std::vector<TermInfo> mixed_terms(const Formulation& m) {
  std::vector<TermInfo> t{{"deformation",
                           "dF/dt = Σ_j (v_j − v_i) ⊗ k_ij B_i, k_ij = V_i V_j ∇W of the start",
                           "[Lee2016] Eq. 33a", "solver/initial_pairs.hpp:difference_sum", exact_gradients}};
  if (m.unknowns == Unknowns::v_F_J)
    t.push_back({"volume ratio", "dJ/dt = H : Σ_j (v_j − v_i) ⊗ k_ij B_i, H = cof F", "[Lee2016] Eq. 33c",
                 "families/tl_mixed/solver.hpp:gather_pass", "mixed: a ring and a disc that collide"});
  t.push_back(law_term(m.law));
  t.push_back({"internal force", internal_force, "[Lee2016] Eq. 29c", "solver/initial_pairs.hpp:pair_sum",
               exact_force});
  if (m.jst)
    t.push_back(
        {"dissipation", "D(U) = c_p dp (ε₂ L[U] − ε₄ dp² L*[L[U]]), L corrected",
         "[Lee2016] Eq. 36, 37, A.1–A.5", "families/tl_mixed/corrected_laplacian.hpp:corrected_laplacian",
         "corrected Laplacian: 0 of linear fields, 2 d of the square of the distance, at surfaces too"});
  t.push_back({"projection", "forces and D(v) nearest to those with Σ V a = 0, Σ V Z × a = 0",
               "[Lee2016] Eq. 45–51", "families/tl_mixed/momentum_projection.hpp:project_on_momenta",
               "projection: the nearest accelerations without force and torque"});
  t.push_back(penalty_term());
  t.push_back({"time", "TVD Runge–Kutta, two stages", "[Lee2016] Eq. 43", "families/tl_mixed/solver.hpp:step",
               "mixed: a ring and a disc that collide"});
  return t;
}

}  // namespace

std::vector<TermInfo> total_lagrangian_terms(const Formulation& m) {
  if (is_mixed(m)) return mixed_terms(m);
  return {
      {"deformation", "F = I + Σ_j (u_j − u_i) ⊗ k_ij B_i, k_ij = V_i V_j ∇W of the start",
       "[Lee2016] Eq. 34", "solver/initial_pairs.hpp:difference_sum", exact_gradients},
      law_term(m.law),
      {"internal force", internal_force, "[Lee2016] Eq. 29c", "solver/initial_pairs.hpp:pair_sum",
       exact_force},
      m.contact == ContactLaw::lennard_jones ? lennard_jones_term() : penalty_term(),
      {"time", "position Verlet, one step", "[Zhang2020] Eq. 10, 11",
       "families/tl_displacement/solver.hpp:step", "total Lagrangian: a ring and a disc that collide"},
  };
}

std::vector<MethodConstant> total_lagrangian_constants(const Formulation& m) {
  // normalised gradients ask for no more neighbours than the four nearest
  const double least_h = m.gradient == GradientCorrection::normalised ? 0.36 : 0.8;
  std::vector<MethodConstant> c{{"h", m.h_over_dp, least_h, 3.0, "smoothing length over the spacing"}};
  if (m.gradient == GradientCorrection::normalised)
    c.push_back({"normalised", 1.0, 0.0, 1.0, "1: gradients over the sum of kernels, 0: as they come"});
  if (m.jst) {
    c.push_back({"eps_v2", 0.0, 0.0, 1.0, "ε₂ of the momentum, for shocks"});
    c.push_back({"eps_v4", 0.125, 0.0, 1.0, "ε₄ of the momentum, against zigzags"});
    c.push_back({"adjoint", 1.0, 0.0, 1.0, "1: biharmonic term L*[L[U]], damps all; 0: L[L[U]] as printed"});
  }
  if (m.jst && m.unknowns == Unknowns::v_F_J) {
    c.push_back({"eps_J2", 0.0, 0.0, 1.0, "ε₂ of the volume ratio"});
    c.push_back(
        {"eps_J4", 1.0 / 256, 0.0, 1.0,
         "ε₄ of the volume ratio: 1/8 near incompressibility, but faces that meet do not last with it"});
  }
  if (is_mixed(m))
    c.push_back({"projection", 1.0, 0.0, 1.0, "1: forces projected on what keeps both momenta, 0: not"});
  return c;
}

}  // namespace taut
