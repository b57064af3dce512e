#include "engine/families/bonded/describe.hpp"

#include "engine/families/bonded/solver.hpp"
#include "engine/terms/contact_laws.hpp"

namespace taut::bonded {

std::vector<TermInfo> terms(const Formulation& m) {
  return {bond_energy_info, bond_force_info,     cancelled_info,          stress_info,
          interface_info,   bonded_damping_info, contact_info(m.contact), bonded_time_info};
}

std::vector<MethodConstant> constants(const Formulation& m, int dim) {
  constexpr std::string_view help = "half of the least reach of bonds over the spacing";
  // in 3D the 26 nearest of a cubic lattice and no others, for which there are weights: between √3/2 and 1
  const MethodConstant h = dim == 3
                               ? MethodConstant{"h", &Constants::h, m.h_over_dp_3d, 0.87, 0.99, help, true}
                               : MethodConstant{"h", &Constants::h, m.h_over_dp, 0.8, 2.0, help, true};
  return {h,
          {"damping", &Constants::damping, 0.01, 0.0, 0.05,
           "damping time τ of the bonds over dp √(ρ0/G), against noise after impacts; 0 conserves energy"}};
}

}  // namespace taut::bonded
