#pragma once

#include "engine/core/threads.hpp"
#include "engine/methods/tl_mixed/fields.hpp"
#include "engine/solver/kick.hpp"

namespace taut {

template <int Dim>
struct TlMixedKernels {
  using Fields = TlMixedFields<Dim>;
  using Actions = StageActions<Dim>;

  bool has_J, has_H;
  void (*start_gradients)(const Fields& f);
  double (*greatest_stiffness)(const Fields& f, const Threads& threads);
  void (*stiffnesses)(const Fields& f, AlignedPack* out);
  void (*set_columns)(const Fields& f, const Threads& threads);
  void (*gather)(const Fields& f, const Threads& threads);
  void (*dissipate)(const Fields& f, const TlMixedConstants& c, const Threads& threads);
  void (*project)(const Fields& f, const TlMixedConstants& c, int first, int last);
  void (*predict)(const Fields& f, const Kick<Dim>& kick, const Actions& actions, const Threads& threads);
  double (*correct)(const Fields& f, const Kick<Dim>& kick, const Actions& actions, const Threads& threads);
  void (*follow)(const Fields& f, double dt, const Threads& threads);
};

}  // namespace taut
