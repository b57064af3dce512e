#include "engine/methods/families.hpp"

namespace taut {

std::vector<TermInfo> bonded_terms() {
  return {
      {"energy", "E = Σ_i V_i [ G Σ_j w_ij φ(r_ij/r0_ij) + U(det F_i) ]", "ours",
       "terms/bond.hpp:bond_energy",
       "bond: the energy is the neo-Hookean one up to third order, in shear up to fifth, not beyond"},
      {"bond force", "f_i = Σ_j k_ij φ′(λ_ij)/λ_ij (x_j − x_i)", "ours, from [Zhang2024] Eq. 20",
       "terms/bond.hpp:bond_slope", "bond: the slopes are those of the energies, and rise"},
      {"pressure force", "f_i = Σ_j (V_i P_i g_ij − V_j P_j g_ji), P = U′(J) cof F", "ours",
       "terms/bond.hpp:Volumetric", "bond: the slopes are those of the energies, and rise"},
      penalty_term(),
      {"time", "position Verlet, one step", "[Zhang2024] Eq. 22–25", "solver/bonded.hpp:step",
       "oenog: 40 steps are those of the formulas, with a clamp, two materials and on a ring"},
  };
}

std::vector<MethodConstant> bonded_constants(const Formulation& m) {
  return {{"h", m.h_over_dp, 0.8, 2.0, "half the least reach of bonds over the spacing"}};
}

}  // namespace taut
