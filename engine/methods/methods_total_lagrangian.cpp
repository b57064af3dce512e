#include "engine/methods/families.hpp"

namespace taut {
namespace {

TermInfo law_term(Law law) {
  constexpr std::string_view test = "laws: no stress at rest, Hooke's law for small strains";
  switch (law) {
    case Law::neo_hookean:
      return {"stress", "P = G J^(−2/3) F + (K (J − 1) − G/3 J^(−5/3) F:F) cof F", "[Lee2016] Eq. 8–12",
              "materials/neo_hookean.hpp:piola", test};
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

}  // namespace

std::vector<TermInfo> total_lagrangian_terms(const Formulation& m) {
  return {
      {"deformation", "F = I + Σ_j (u_j − u_i) ⊗ k_ij B_i, k_ij = V_i V_j ∇W of the start",
       "[Lee2016] Eq. 34", "solver/reference_pairs.hpp:ReferencePairs",
       "pairs of the start: antisymmetric, within a body, gradients of linear fields exact"},
      law_term(m.law),
      {"internal force", "f_i = Σ_j (V_i P_i B_i + V_j P_j B_j) k_ij", "[Lee2016] Eq. 29c",
       "solver/total_lagrangian.hpp:TotalLagrangian",
       "pairs of the start: the force is minus the derivative of the energy"},
      penalty_term(),
      {"time", "position Verlet, one step", "[Zhang2020] Eq. 10, 11", "solver/total_lagrangian.hpp:step",
       "total Lagrangian: a ring and a disc that collide"},
  };
}

std::vector<MethodConstant> total_lagrangian_constants(const Formulation& m) {
  return {{"h", m.h_over_dp, 0.8, 3.0, "smoothing length over the spacing"}};
}

}  // namespace taut
