#pragma once

#include "engine/families/make_solver.hpp"
#include "engine/methods/all_methods.hpp"

namespace taut::inline TAUT_ISA {

/// How a family makes the solver of one of its methods. Its solver.cpp specialises this and then instantiates
/// make_solver_of.
template <Family F>
struct SolverOf;  // template <const Formulation& M, int Dim> static std::unique_ptr<Simulation> make(input)

template <Family F, int Dim, const Formulation&... M>
std::unique_ptr<Simulation> make_among(const SolverInput& input, MethodList<M...>) {
  std::unique_ptr<Simulation> simulation;
  const auto made = [&]<const Formulation & Each>() {
    if constexpr (Each.family == F && greatest_dim(Each) >= Dim) {
      if (Each.name != input.method.name) return false;
      simulation = SolverOf<F>::template make<Each, Dim>(input);
      return true;
    } else {
      return false;
    }
  };
  static_cast<void>((made.template operator()<M>() || ...));
  return simulation;
}

template <Family F>
std::unique_ptr<Simulation> make_solver_of(const SolverInput& input) {
  return input.scene.dim == 3 ? make_among<F, 3>(input, Methods{}) : make_among<F, 2>(input, Methods{});
}

}  // namespace taut::inline TAUT_ISA
