// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/families/ul_cauchy/solver.hpp"

#include "engine/families/instantiate.hpp"

namespace taut::inline TAUT_ISA {

template <>
struct SolverOf<Family::ul_cauchy> {
  template <const Formulation& M, int Dim>
  static std::unique_ptr<Simulation> make(const SolverInput& input) {
    return std::make_unique<UlCauchy<M, Dim>>(input);
  }
};
template std::unique_ptr<Simulation> make_solver_of<Family::ul_cauchy>(const SolverInput&);

}  // namespace taut::inline TAUT_ISA
