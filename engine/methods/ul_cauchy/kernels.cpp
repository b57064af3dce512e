// Compiled once per instruction set.
#include "engine/methods/ul_cauchy/kernels.hpp"

#include "engine/methods/kernel_tables.hpp"
#include "engine/methods/ul_cauchy/methods.hpp"
#include "engine/methods/ul_cauchy/passes.hpp"

namespace taut {
namespace {

struct Tables {
  template <const UlCauchyFormulation& M, int Dim>
  static constexpr UlCauchyKernels<Dim> of{
      .support = Kernel<M.kernel>::support,
      .stress_row = sizeof(StressRow<M, Dim>),
      .needs_kernel = needs_kernel(M),
      .gradients = gradient_pass<M, Dim>,
      .stresses = stress_pass<M, Dim>,
      .transport = transport_pass<M, Dim>,
      .rates = rate_pass<M, Dim>,
  };
};

}  // namespace

template <>
const void* kernels_of<int(Family::ul_cauchy)>(int dim, std::string_view method) {
  return table_among<Tables>(dim, method, ul_cauchy::Methods{});
}

}  // namespace taut
