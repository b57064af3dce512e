#pragma once

#include "engine/core/threads.hpp"
#include "engine/methods/finite_elements/fields.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

template <int Dim>
struct FiniteElementKernels {
  using Fields = FiniteElementFields<Dim>;

  void (*drift)(const Fields& f, double dt, const Threads& threads);
  void (*elements)(const Fields& f, const Threads& threads);
  double (*nodes)(const Fields& f, const Kick<Dim>& kick, const Threads& threads);
  void (*strains)(const Fields& f, const int* groups, int count, Mat<Pack, Dim>* out, const Threads& threads);
  double (*rate)(const Fields& f, const Threads& threads);
};

}  // namespace taut
