#pragma once

#include "engine/core/columns.hpp"
#include "engine/materials/chosen_laws.hpp"
#include "engine/methods/bonded/cancelled.hpp"
#include "engine/methods/bonded/formulation.hpp"
#include "engine/methods/bonded/packed_bonds.hpp"
#include "engine/methods/bonded/shown_stress.hpp"
#include "engine/terms/bond.hpp"

/// Plain data of the bonded family, for its passes.
namespace taut {

/// The family's own law for four particles.
struct alignas(sizeof(Pack)) GroupLaw {
  Pack V;  // m^Dim, weights the energy; 0 of the filling and of particles without F
  ClosedNeoHookean<Pack> law;
};
/// Indices of a group's constants.
struct GroupRows {
  int law, B;
};

template <int Dim, class Storage>
struct BondsView {
  PackedBondsView<Dim, Storage> packed;
  CancelledView<Dim, Storage> cancelled;
};

template <int Dim>
struct BondedFields {
  using V = Vec<double, Dim>;

  int size;                     // particles
  V* x;                         // m
  const V* v;                   // m/s
  ColumnsView<2 * Dim> places;  // x, x + 3 τ v; clamp places behind the particles
  ColumnsView<Dim * Dim> Q;     // T B, row by row
  const double* mobility;       // 1/m, or 0 of constrained particles, 1/kg
  Vec<Pack, Dim>* bond_force;   // [group] N
  double lead;                  // 3 τ of the bonds, s
  double least_r2;              // m²: a bond is never shorter than a hundredth of a spacing
  bool own_law;                 // the law in GroupLaw; else `laws`
  LawsInUse laws;
  const int* material;  // with the filling of the last group
  const GroupRows* groups;
  const GroupLaw* group_laws;
  const Mat<Pack, Dim>* B;
  BondsView<Dim, AlignedPack> bonds;
  BondsView<Dim, HalfPack> halved_bonds;  // off-lattice in 3D, where each particle has constants of its own
  bool halved;

  int group_count() const { return (size + lanes - 1) / lanes; }
  const GroupLaw& law(int group) const { return group_laws[groups[group].law]; }
  const Mat<Pack, Dim>& B_of(int group) const { return B[groups[group].B]; }
  void set_place(int i) const {
    for (int k = 0; k < Dim; ++k) places[k][i] = x[i][k], places[Dim + k][i] = x[i][k] + lead * v[i][k];
  }
  /// pass(bonds) with the bonds in use.
  template <class Pass>
  auto with_bonds(const Pass& pass) const {
    if constexpr (Dim == 3)
      if (halved) return pass(halved_bonds);
    return pass(bonds);
  }
};

/// A group of four particles in a snapshot.
template <int Dim>
struct alignas(sizeof(Pack)) ShownGroup {
  ShownStress<Pack, Dim> stress;
  Pack energy;  // J, without interfaces
};

}  // namespace taut
