// Compiled once per instruction set.
#include "engine/methods/tl_mixed/kernels.hpp"

#include "engine/methods/kernel_tables.hpp"
#include "engine/methods/tl_mixed/methods.hpp"
#include "engine/methods/tl_mixed/passes.hpp"

namespace taut {
namespace {

struct Tables {
  template <const TlMixedFormulation& M, int Dim>
  static constexpr TlMixedKernels<Dim> of{
      .has_J = UnknownsOf<M, Dim>::has_J,
      .has_H = UnknownsOf<M, Dim>::has_H,
      .start_gradients = start_gradients<M, Dim>,
      .greatest_stiffness = greatest_stiffness<M, Dim>,
      .stiffnesses = stiffnesses<M, Dim>,
      .set_columns = set_columns<M, Dim>,
      .gather = gather_pass<M, Dim>,
      .dissipate = dissipation_pass<M, Dim>,
      .project = project<M, Dim>,
      .predict = predict<M, Dim>,
      .correct = correct<M, Dim>,
      .follow = follow<M, Dim>,
  };
};

}  // namespace

template <>
const void* kernels_of<int(Family::tl_mixed)>(int dim, std::string_view method) {
  return table_among<Tables>(dim, method, tl_mixed::Methods{});
}

}  // namespace taut
