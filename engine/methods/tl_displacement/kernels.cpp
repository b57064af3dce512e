// Compiled once per instruction set.
#include "engine/methods/tl_displacement/kernels.hpp"

#include "engine/methods/kernel_tables.hpp"
#include "engine/methods/tl_displacement/methods.hpp"
#include "engine/methods/tl_displacement/passes.hpp"

namespace taut {
namespace {

struct Tables {
  template <const TlDisplacementFormulation& M, int Dim>
  static constexpr TlDisplacementKernels<Dim> of{
      .drift = drift<M, Dim>,
      .stresses = stress_pass<M, Dim>,
      .forces = force_pass<M, Dim>,
      .deform = deform<M, Dim>,
  };
};

}  // namespace

template <>
const void* kernels_of<int(Family::tl_displacement)>(int dim, std::string_view method) {
  return table_among<Tables>(dim, method, tl_displacement::Methods{});
}

}  // namespace taut
