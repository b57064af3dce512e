#pragma once

#include "engine/core/threads.hpp"
#include "engine/methods/ul_split/fields.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

template <int Dim>
struct UlSplitKernels {
  using Fields = UlSplitFields<Dim>;

  double support;  // in h
  double (*steepness)(const UlSplitConstants& c);
  void (*geometry)(const Fields& f, const UlSplitConstants& c, const Threads& threads);
  void (*contact_geometry)(const Fields& f, const UlSplitConstants& c);
  void (*half_drift)(const Fields& f, const UlSplitConstants& c, double dt, const Threads& threads);
  double (*momentum)(const Fields& f, const UlSplitConstants& c, const Kick<Dim>& kick,
                     const Threads& threads);
  void (*rates)(const Fields& f, const UlSplitConstants& c, const Steering<Dim>& steering, double dt,
                const Threads& threads);
  void (*recover_stress)(const Fields& f, const UlSplitConstants& c, const FlowRow<Dim>* displacement,
                         const int* particles, int count, Sym<double, Dim>* out, const Threads& threads);
  Vec<double, Dim> (*force_between)(const Fields& f, const UlSplitConstants& c, int a, int b);
};

}  // namespace taut
