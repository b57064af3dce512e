#pragma once

#include "engine/core/columns.hpp"
#include "engine/materials/chosen_laws.hpp"
#include "engine/methods/tl_displacement/formulation.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/solver/sites.hpp"

namespace taut {

template <int Dim>
struct TlDisplacementFields {
  using V = Vec<double, Dim>;

  int size;
  V* x;
  const V *v, *X;
  const int* material;
  const Sites<Dim>* sites;
  LawsInUse laws;
  PairLanesView<Dim> pairs;
  ColumnsView<Dim> displacement;  // u = x − X, m
  ColumnsView<Dim * Dim> stress;  // V P B, row by row, N/m^(Dim − 1); pair shear: P, Pa
  // null without a pair force
  PairLanesView<Dim, Dim + 2> bonds;  // X_i − X_j and weights
  ColumnsView<Dim * Dim> F;           // only with the hourglass force
  ColumnsView<Dim> velocity;          // pair shear: v before the kick, m/s
  ColumnsView<1> viscosity, shear;    // pair shear: χ, Pa s; g, Pa
  double shear_factor;

  int groups() const { return (size + lanes - 1) / lanes; }
};

}  // namespace taut
