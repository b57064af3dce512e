// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/families/tl_displacement/kernels.hpp"

#include "engine/families/kernel_tables.hpp"
#include "engine/families/tl_displacement/methods.hpp"
#include "engine/families/tl_displacement/passes.hpp"

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
