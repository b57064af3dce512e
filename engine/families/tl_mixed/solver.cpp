// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/families/tl_mixed/solver.hpp"

#include "engine/families/instantiate.hpp"

namespace taut::inline TAUT_ISA {

template <>
struct SolverOf<Family::tl_mixed> {
  template <const Formulation& M, int Dim>
  static std::unique_ptr<Simulation> make(const SolverInput& input) {
    return std::make_unique<TlMixed<M, Dim>>(input);
  }
};
template std::unique_ptr<Simulation> make_solver_of<Family::tl_mixed>(const SolverInput&);

}  // namespace taut::inline TAUT_ISA
