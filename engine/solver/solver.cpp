// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/solver/solver.hpp"

#include "engine/methods/all.hpp"
#include "engine/solver/bonded.hpp"
#include "engine/solver/cauchy_stress.hpp"
#include "engine/solver/updated_lagrangian.hpp"

namespace taut::inline TAUT_ISA {
namespace {

template <const Formulation& M, int Dim>
using SolverOf =
    std::conditional_t<M.shear == Shear::bonds, Bonded<M, Dim>,
                       std::conditional_t<M.shear == Shear::cauchy_stress, CauchyStress<M, Dim>,
                                          UpdatedLagrangian<M, Dim>>>;

template <int Dim, const Formulation&... M>
std::unique_ptr<Simulation> make(std::string_view method, const SolverInput& input, MethodList<M...>) {
  std::unique_ptr<Simulation> simulation;
  const auto made = [&]<const Formulation & F>() {
    if (F.name != method) return false;
    simulation = std::make_unique<SolverOf<F, Dim>>(input);
    return true;
  };
  static_cast<void>((made.template operator()<M>() || ...));
  return simulation;
}

}  // namespace

std::unique_ptr<Simulation> make_solver(std::string_view method, const SolverInput& input) {
  return make<2>(method, input, Methods{});
}

}  // namespace taut::inline TAUT_ISA
