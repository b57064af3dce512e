// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/families/tl_displacement/solver.hpp"

#include "engine/families/instantiate.hpp"

namespace taut::inline TAUT_ISA {

template <>
struct SolverOf<Family::tl_displacement> {
  template <const Formulation& M, int Dim>
  static std::unique_ptr<Simulation> make(const SolverInput& input) {
    return std::make_unique<TlDisplacement<M, Dim>>(input);
  }
};
template std::unique_ptr<Simulation> make_solver_of<Family::tl_displacement>(const SolverInput&);

}  // namespace taut::inline TAUT_ISA
