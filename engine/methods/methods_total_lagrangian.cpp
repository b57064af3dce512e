#include "engine/methods/methods_total_lagrangian.hpp"

namespace taut {
namespace {

std::string_view law_term(Law law) {
  switch (law) {
    case Law::neo_hookean:
      return "stress             P = G J^(−2/3) F + (K (J − 1) − G/3 J^(−5/3) F:F) cof F     [Lee2016] Eq. "
             "8–12";
    case Law::st_venant_kirchhoff:
      return "stress             P = F (2G dev E + K tr E I), E = ½ (FᵀF − I)               "
             "materials/st_venant_kirchhoff.hpp";
    case Law::linear_elastic:
      return "stress             P = 2G dev ε + K tr ε I, ε = ½ (F + Fᵀ) − I                [Zhang2020] Eq. "
             "3, 4";
    case Law::rotated_piola:
      return "stress             P = R (2G dev E + K tr E I), F = R U, E = ½ (FᵀF − I)       [TranDuc2023] "
             "§2.3";
    case Law::none:
      break;
  }
  return "";
}

}  // namespace

std::vector<std::string_view> total_lagrangian_terms(const Formulation& m) {
  return {
      "deformation        F = I + Σ_j (u_j − u_i) ⊗ k_ij B_i, k_ij = V_i V_j ∇W of the start  [Lee2016] Eq. "
      "34",
      law_term(m.law),
      "internal force     f_i = Σ_j (V_i P_i B_i + V_j P_j B_j) k_ij                               [Lee2016] "
      "Eq. "
      "29c",
      "contact            f = K dp^(d−2) (dp − r) between bodies                             [TranDuc2023] "
      "Eq. 2.13",
      "time               position Verlet, one step                                          [Zhang2020] Eq. "
      "10, 11",
  };
}

std::vector<MethodConstant> total_lagrangian_constants(const Formulation& m) {
  return {{"h", m.h_over_dp, 0.8, 3.0, "smoothing length over the spacing"}};
}

}  // namespace taut
