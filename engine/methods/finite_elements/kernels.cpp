// Compiled once per instruction set.
#include "engine/methods/finite_elements/kernels.hpp"

#include "engine/methods/finite_elements/methods.hpp"
#include "engine/methods/finite_elements/passes.hpp"
#include "engine/methods/kernel_tables.hpp"

namespace taut {
namespace {

struct Tables {
  template <const FiniteElementFormulation& M, int Dim>
  static constexpr FiniteElementKernels<Dim> of{
      .drift = drift<M, Dim>,
      .elements = element_pass<M, Dim>,
      .nodes = node_pass<M, Dim>,
      .strains = strain_pass<M, Dim>,
      .rate = rate_pass<M, Dim>,
  };
};

}  // namespace

template <>
const void* kernels_of<int(Family::finite_elements)>(int dim, std::string_view method) {
  return table_among<Tables>(dim, method, finite_elements::Methods{});
}

}  // namespace taut
