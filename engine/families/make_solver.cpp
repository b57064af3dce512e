// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/families/make_solver.hpp"

#include <utility>

#include "engine/families/families.hpp"

namespace taut::inline TAUT_ISA {

std::unique_ptr<Simulation> make_solver(const SolverInput& input) {
  std::unique_ptr<Simulation> simulation;
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    static_cast<void>(((input.method.family == families[k].family &&
                        (simulation = make_solver_of<families[k].family>(input), true)) ||
                       ...));
  }
  (std::make_index_sequence<families.size()>());
  return simulation;
}

}  // namespace taut::inline TAUT_ISA
