#include "engine/families/bonded/describe.hpp"

#include "engine/families/bonded/solver.hpp"

namespace taut::bonded {

std::vector<TermInfo> terms(const Formulation& m) {
  return {bond_energy_info,    bond_force_info,         cancelled_info,  stress_info,
          bonded_damping_info, contact_info(m.contact), bonded_time_info};
}

std::vector<MethodConstant> constants(const Formulation& m, int dim) {
  const double h = dim == 3 ? 0.9 : m.h_over_dp;  // the 26 nearest on a cubic lattice
  return {{"h", &Constants::h, h, 0.8, 2.0, "half the least reach of bonds over the spacing", true},
          {"damping", &Constants::damping, 0.01, 0.0, 0.05,
           "τ of the bonds over dp √(ρ0/G), against what a blow leaves; 0 keeps the energy"}};
}

}  // namespace taut::bonded
