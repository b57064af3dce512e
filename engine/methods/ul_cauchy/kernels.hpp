#pragma once

#include <cstddef>

#include "engine/core/threads.hpp"
#include "engine/methods/ul_cauchy/fields.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

template <int Dim>
struct UlCauchyKernels {
  using Fields = UlCauchyFields<Dim>;

  double support;          // in h
  std::size_t stress_row;  // bytes
  bool needs_kernel;
  void (*gradients)(const Fields& f, const UlCauchyConstants& c, const Threads& threads);
  double (*stresses)(const Fields& f, const UlCauchyConstants& c, const Kick<Dim>& kick,
                     const Threads& threads);
  double (*transport)(const Fields& f, const UlCauchyConstants& c, const Steering<Dim>& steering,
                      double ahead, const Threads& threads);
  void (*rates)(const Fields& f, const UlCauchyConstants& c, double dt, const Threads& threads);
};

}  // namespace taut
