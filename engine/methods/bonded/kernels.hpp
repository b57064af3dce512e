#pragma once

#include "engine/core/threads.hpp"
#include "engine/methods/bonded/fields.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

template <int Dim>
struct BondedKernels {
  using Fields = BondedFields<Dim>;

  void (*half_drift)(const Fields& f, double dt, const Threads& threads);
  double (*stresses)(const Fields& f, const Threads& threads);
  double (*forces)(const Fields& f, const Kick<Dim>& kick, const Threads& threads);
  void (*inner_forces)(const Fields& f, Vec<double, Dim>* out, const Threads& threads);
  void (*energies)(const Fields& f, AlignedPack* out, const Threads& threads);
  void (*show)(const Fields& f, const RecoveredView& recovered, const AlignedPack* displacements,
               const int* groups, int count, ShownGroup<Dim>* out, const Threads& threads);
};

}  // namespace taut
