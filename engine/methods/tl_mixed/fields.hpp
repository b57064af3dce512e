#pragma once

#include "engine/core/columns.hpp"
#include "engine/materials/chosen_laws.hpp"
#include "engine/methods/tl_mixed/formulation.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/solver/sites.hpp"

/// Plain data of the mixed total-Lagrangian methods, for their passes.
namespace taut {

/// Unknowns beside places and velocities, four particles at a time, or their rates.
template <int Dim>
struct Strains {
  Mat<Pack, Dim>* F;
  AlignedPack* J;     // volume ratio, where it is an unknown; else null
  Mat<Pack, Dim>* H;  // cofactor of F, where it is one; else null
};

/// External actions on stages of a step, on particle i at a time; see Common.
template <int Dim>
struct StageActions {
  using V = Vec<double, Dim>;

  void* of;
  /// Adds the acceleration by loads to `a`; null: there are none.
  void (*load)(void* of, int i, V& a);
  /// Replaces the velocity `v` after the first stage where drives or guides determine it; null: there are none.
  void (*steer)(void* of, int i, V& v);
  /// Replaces the velocity `v` at the end of a step of `dt` that began with `before`, and counts the work of loads and
  /// drives; null: none acts.
  void (*close)(void* of, int i, double dt, const V& before, V& v);
};

template <int Dim>
struct TlMixedFields {
  using V = Vec<double, Dim>;

  int size;  // particles
  V *x, *v;  // m, m/s
  const double* m;
  V* v_start;  // m/s, at the start of the step
  const V* X;
  const double* V0;
  const int* material;
  const Sites<Dim>* sites;
  LawsInUse laws;
  double wave_speed;                              // c_p, m/s
  PairLanesView<Dim> pairs;                       // of a method without dissipation: k_ij
  PairLanesView<Dim, Dim + 2> dissipating_pairs;  // of one with it: k_ij, w_ij dp² and that of L*
  Strains<Dim> now, start, rate;  // at the stage, at the start of the step; rates at the stage
  ColumnsView<Dim + 1> flow;      // v, m/s, and J
  ColumnsView<Dim * Dim> stress;  // V P B, row by row
  ColumnsView<Dim + 1> once;      // dp² L of (v, J)
  ColumnsView<Dim> a, a_start;    // without contact and loads; of all at the start, m/s²
  ColumnsView<1> dissipation_J;   // 1/s

  int groups() const { return (size + lanes - 1) / lanes; }
};

}  // namespace taut
