#include "engine/families/describe.hpp"

namespace taut {

std::vector<TermInfo> bonded_terms() {
  return {
      {"energy", "E = Σ_i V_i [ G Σ_j w_ij φ(r_ij/r0_ij) + U_i(F_i) ]", "ours", "terms/bond.hpp:bond_energy",
       "bond: a linear displacement has the neo-Hookean energy and stress"},
      {"bond force", "f_i = Σ_j k_ij φ′(λ_ij)/λ_ij (x_j − x_i), φ = (2λ⁴ − 3λ² + λ⁻²)/24",
       "ours, from [Zhang2024] Eq. 20", "terms/bond.hpp:bond_slope",
       "bond: the slopes are those of the energies, and rise"},
      {"stress",
       "f_i = Σ_j (V_i P_i g_ij − V_j P_j g_ji), P = ∂U/∂F, U = W − G (t² − t − J²/3 + (1 − R/4)/(3J))",
       "ours", "terms/bond.hpp:Remainder", "bond: the slopes are those of the energies, and rise"},
      {"damping", "f_i = Σ_j k_ij τ q̇_ij (x_j − x_i), q = ½ (λ² − 1), τ = damping dp √(ρ0/G)", "ours",
       "families/bonded/solver.hpp:strained",
       "oenog: the damping takes a zigzag away and leaves the first mode alone"},
      penalty_term(),
      {"time", "position Verlet, one step", "[Zhang2024] Eq. 22–25", "families/bonded/solver.hpp:step",
       "oenog: 40 steps are those of the formulas, with a clamp, two materials and on a ring"},
  };
}

std::vector<MethodConstant> bonded_constants(const Formulation& m) {
  return {{"h", m.h_over_dp, 0.8, 2.0, "half the least reach of bonds over the spacing"},
          {"damping", 0.01, 0.0, 0.05,
           "τ of the bonds over dp √(ρ0/G), against what a blow leaves; 0 keeps the energy"}};
}

}  // namespace taut
