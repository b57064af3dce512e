// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/families/make_solver.hpp"

#include <type_traits>
#include <utility>

#include "engine/families/all_methods.hpp"
#include "engine/families/bonded/solver.hpp"
#include "engine/families/tl_displacement/solver.hpp"
#include "engine/families/tl_mixed/solver.hpp"
#include "engine/families/ul_cauchy/solver.hpp"
#include "engine/families/ul_split/solver.hpp"

namespace taut::inline TAUT_ISA {
namespace {

/// The solver of a method for its scenes' dimension.
template <const Formulation& M, int Dim>
auto solver_of() {
  if constexpr (M.shear == Shear::bonds)
    return std::type_identity<Bonded<M, Dim>>();
  else if constexpr (M.shear == Shear::cauchy_stress)
    return std::type_identity<UlCauchy<M, Dim>>();
  else if constexpr (is_mixed(M))
    return std::type_identity<TlMixed<M, Dim>>();
  else if constexpr (M.shear == Shear::reference_stress)
    return std::type_identity<TlDisplacement<M, Dim>>();
  else
    return std::type_identity<UlSplit<M, Dim>>();
}
template <const Formulation& M, int Dim>
using SolverOf = typename decltype(solver_of<M, Dim>())::type;

/// With the law that the input asks for, where the method leaves it free.
template <const Formulation& M, int Dim>
std::unique_ptr<Simulation> make_with_law(const SolverInput& input) {
  if constexpr (M.free_law) {
    std::unique_ptr<Simulation> simulation;
    const auto made = [&]<Law law>() {
      if (input.law != law) return false;
      simulation = std::make_unique<SolverOf<with_law<M, law>, Dim>>(input);
      return true;
    };
    [&]<std::size_t... k>(std::index_sequence<k...>) {
      static_cast<void>((made.template operator()<free_laws[k]>() || ...));
    }
    (std::make_index_sequence<free_laws.size()>());
    return simulation;
  } else {
    return std::make_unique<SolverOf<M, Dim>>(input);
  }
}

template <int Dim, const Formulation&... M>
std::unique_ptr<Simulation> make(std::string_view method, const SolverInput& input, MethodList<M...>) {
  std::unique_ptr<Simulation> simulation;
  const auto made = [&]<const Formulation & F>() {
    if (F.name != method) return false;
    simulation = make_with_law<F, Dim>(input);
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
