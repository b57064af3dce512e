#pragma once

#include "engine/core/columns.hpp"
#include "engine/materials/chosen_laws.hpp"
#include "engine/methods/tl_mixed/formulation.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/solver/sites.hpp"

namespace taut {

template <int Dim>
struct Strains {
  Mat<Pack, Dim>* F;
  AlignedPack* J;     // null unless an unknown
  Mat<Pack, Dim>* H;  // cofactor of F; null unless an unknown
};

/// External actions on particle i; null if inactive.
template <int Dim>
struct StageActions {
  using V = Vec<double, Dim>;

  void* of;
  /// Adds to `a`, m/s².
  void (*load)(void* of, int i, V& a);
  /// Sets prescribed `v` after the first stage.
  void (*steer)(void* of, int i, V& v);
  /// Sets prescribed `v` at the end of the step and adds the work. `before`: v at the start.
  void (*close)(void* of, int i, double dt, const V& before, V& v);
};

template <int Dim>
struct TlMixedFields {
  using V = Vec<double, Dim>;

  int size;
  V *x, *v;
  const double* m;
  V* v_start;
  const V* X;
  const double* V0;
  const int* material;
  const Sites<Dim>* sites;
  LawsInUse laws;
  double wave_speed;  // c_p of the unstrained body, m/s
  bool one_sided;
  PairLanesView<Dim> pairs;                       // k_ij
  PairLanesView<Dim, Dim + 2> dissipating_pairs;  // k_ij, dp² × weights of L and of its adjoint L*
  Strains<Dim> now, start, rate;                  // at the stage; at the start of the step; rates, 1/s
  ColumnsView<Dim + 1> flow;                      // v, m/s, and J
  ColumnsView<Dim * Dim> stress;                  // V P B, or P if one-sided, row by row
  ColumnsView<Dim + 1> once;                      // dp² L[(v, J)], L of corrected_laplacian.hpp
  ColumnsView<Dim> a, a_start;                    // m/s²: internal; total at the start of the step
  ColumnsView<1> dissipation_J;                   // 1/s

  int groups() const { return (size + lanes - 1) / lanes; }
};

}  // namespace taut
