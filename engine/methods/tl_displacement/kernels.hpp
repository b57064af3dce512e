#pragma once

#include "engine/core/threads.hpp"
#include "engine/methods/tl_displacement/fields.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

template <int Dim>
struct TlDisplacementKernels {
  using Fields = TlDisplacementFields<Dim>;

  void (*drift)(const Fields& f, double dt, const Threads& threads);
  void (*stresses)(const Fields& f, const Threads& threads);
  double (*forces)(const Fields& f, const Kick<Dim>& kick, const Threads& threads);
  void (*deform)(const Fields& f, const int* groups, int count, Mat<Pack, Dim>* out, const Threads& threads);
};

}  // namespace taut
