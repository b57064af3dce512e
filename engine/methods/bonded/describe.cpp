#include "engine/methods/bonded/describe.hpp"

#include "engine/methods/bonded/bond_sums.hpp"
#include "engine/methods/bonded/half_cells.hpp"
#include "engine/methods/bonded/interface_sites.hpp"
#include "engine/terms/contact_laws.hpp"

namespace taut::bonded {
namespace {

constexpr TermInfo time_info{
    "time", "position Verlet, one step", "[Zhang2024] Eq. 22–25", "methods/bonded/solver.cpp:step",
    "oenog: 40 steps of clamped two-material plates and a ring agree with a plain implementation"};

}  // namespace

std::vector<TermInfo> terms(const BondedFormulation& m) {
  return {bond_energy_info, bond_force_info,     cancelled_info,          stress_info, interface_info,
          half_cell_info,   bonded_damping_info, contact_info(m.contact), time_info};
}

std::vector<ConstantRow<BondedConstants>> constants(const BondedFormulation& m, int dim) {
  constexpr std::string_view help = "half of the least reach of bonds, over the spacing";
  // 3D: this range selects the 26 nearest on a cubic lattice
  const MethodConstant h = dim == 3 ? MethodConstant{"h", m.h_over_dp_3d, 0.87, 0.99, help, true, true}
                                    : MethodConstant{"h", m.h_over_dp, 0.8, 2.0, help, true, true};
  return {{&BondedConstants::h, h},
          {&BondedConstants::damping,
           {"damping", 0.01, 0.0, 0.05,
            "damping time τ of the bonds over dp √(ρ0/G); damps noise after impacts; 0 conserves energy"}}};
}

}  // namespace taut::bonded
