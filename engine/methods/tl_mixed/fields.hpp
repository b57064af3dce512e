#pragma once

#include "engine/core/columns.hpp"
#include "engine/materials/chosen_laws.hpp"
#include "engine/methods/tl_mixed/formulation.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/solver/sites.hpp"

namespace taut {

/// Unknowns or rates of four particles.
template <int Dim>
struct Strains {
  Mat<Pack, Dim>* F;
  AlignedPack* J;     // may be null
  Mat<Pack, Dim>* H;  // cofactor of F; may be null
};

/// External actions on particle i; may be null.
template <int Dim>
struct StageActions {
  using V = Vec<double, Dim>;

  void* of;
  /// Adds loads to `a`.
  void (*load)(void* of, int i, V& a);
  /// Sets a prescribed `v` after the first stage.
  void (*steer)(void* of, int i, V& v);
  /// Sets a prescribed `v` after a step and counts work.
  void (*close)(void* of, int i, double dt, const V& before, V& v);
};

template <int Dim>
struct TlMixedFields {
  using V = Vec<double, Dim>;

  int size;
  V *x, *v;  // m, m/s
  const double* m;
  V* v_start;  // m/s, at the start of the step
  const V* X;
  const double* V0;
  const int* material;
  const Sites<Dim>* sites;
  LawsInUse laws;
  double wave_speed;                              // c_p, m/s
  PairLanesView<Dim> pairs;                       // k_ij
  PairLanesView<Dim, Dim + 2> dissipating_pairs;  // k_ij, w_ij dp², adjoint weight
  Strains<Dim> now, start, rate;                  // at the stage, at the start of the step; rates
  ColumnsView<Dim + 1> flow;                      // v, m/s, and J
  ColumnsView<Dim * Dim> stress;                  // V P B, row by row
  ColumnsView<Dim + 1> once;                      // dp² L of (v, J)
  ColumnsView<Dim> a, a_start;                    // internal; total at the start, m/s²
  ColumnsView<1> dissipation_J;                   // 1/s

  int groups() const { return (size + lanes - 1) / lanes; }
};

}  // namespace taut
