// Compiled once per instruction set.
#include "engine/methods/ul_split/kernels.hpp"

#include "engine/methods/kernel_tables.hpp"
#include "engine/methods/ul_split/methods.hpp"
#include "engine/methods/ul_split/passes.hpp"

namespace taut {
namespace {

struct Tables {
  template <const UlSplitFormulation& M, int Dim>
  static constexpr UlSplitKernels<Dim> of{
      .support = std::max(Kernel<M.kernel>::support, Kernel<KernelName::cubic_spline>::support),
      .steepness = steepness<M, Dim>,
      .geometry = geometry_pass<M, Dim>,
      .contact_geometry = contact_geometry_pass<M, Dim>,
      .half_drift = half_drift<M, Dim>,
      .momentum = momentum_pass<M, Dim>,
      .rates = rate_pass<M, Dim>,
      .recover_stress = recover_stress<M, Dim>,
      .force_between = force_between<M, Dim>,
  };
};

}  // namespace

template <>
const void* kernels_of<int(Family::ul_split)>(int dim, std::string_view method) {
  return table_among<Tables>(dim, method, ul_split::Methods{});
}

}  // namespace taut
