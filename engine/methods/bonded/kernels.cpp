// Compiled once per instruction set.
#include "engine/methods/bonded/kernels.hpp"

#include "engine/methods/bonded/methods.hpp"
#include "engine/methods/bonded/passes.hpp"
#include "engine/methods/kernel_tables.hpp"

namespace taut {
namespace {

struct Tables {
  template <const BondedFormulation& M, int Dim>
  static constexpr BondedKernels<Dim> of{
      .half_drift = half_drift<M, Dim>,
      .stresses = stress_pass<M, Dim>,
      .forces = force_pass<M, Dim>,
      .inner_forces = inner_forces<M, Dim>,
      .energies = energy_pass<M, Dim>,
      .show = show_pass<M, Dim>,
  };
};

}  // namespace

template <>
const void* kernels_of<int(Family::bonded)>(int dim, std::string_view method) {
  return table_among<Tables>(dim, method, bonded::Methods{});
}

}  // namespace taut
