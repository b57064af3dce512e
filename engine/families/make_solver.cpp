// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/families/make_solver.hpp"

#include <utility>

#include "engine/families/families.hpp"

namespace taut::inline TAUT_ISA {

namespace {
/// Whether this instruction set is built for a family; see engine/CMakeLists.txt.
constexpr bool built_for([[maybe_unused]] const FamilyRow& family) {
#ifdef TAUT_FAMILIES_SHORT_OF_REGISTERS
  return family.short_of_registers;
#else
  return true;
#endif
}
}  // namespace

std::unique_ptr<Simulation> make_solver(const SolverInput& input) {
  std::unique_ptr<Simulation> simulation;
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    const auto made = [&]<std::size_t n>() {
      if constexpr (built_for(families[n]))
        if constexpr (families[n].make == nullptr)
          if (input.method.family == families[n].family) simulation = make_solver_of<families[n].family>(input);
      return simulation != nullptr;
    };
    static_cast<void>((made.template operator()<k>() || ...));
  }
  (std::make_index_sequence<families.size()>());
  return simulation;
}

}  // namespace taut::inline TAUT_ISA
