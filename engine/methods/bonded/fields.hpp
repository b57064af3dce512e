#pragma once

#include "engine/core/columns.hpp"
#include "engine/materials/chosen_laws.hpp"
#include "engine/methods/bonded/cancelled.hpp"
#include "engine/methods/bonded/formulation.hpp"
#include "engine/methods/bonded/packed_bonds.hpp"
#include "engine/methods/bonded/shown_stress.hpp"
#include "engine/terms/bond.hpp"

namespace taut {

/// Volumes and default law of four particles.
struct alignas(sizeof(Pack)) GroupLaw {
  Pack V;  // in m^Dim; 0 in padding and for particles whose bonds determine no F
  ClosedNeoHookean<Pack> law;
};
/// Indices in `group_laws` and `B`.
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

  int size;
  V* x;
  const V* v;
  ColumnsView<2 * Dim> places;  // x, x + 3 τ v of particles, then of clamp places
  ColumnsView<Dim * Dim> Q;     // T B, row by row (THEORY.md, Energy)
  const double* mobility;       // 1/kg; 0 if clamped
  Vec<Pack, Dim>* bond_force;   // [group] in N
  double lead;                  // 3 τ in s (THEORY.md, Damping)
  double least_r2;              // minimum of r² in m²
  bool uses_group_law;
  LawsInUse laws;
  const int* material;  // padded to whole groups
  const GroupRows* groups;
  const GroupLaw* group_laws;
  const Mat<Pack, Dim>* B;  // inverse moment matrices
  BondsView<Dim, AlignedPack> bonds;
  BondsView<Dim, HalfPack> halved_bonds;  // off-lattice in 3D
  bool halved;

  int group_count() const { return (size + lanes - 1) / lanes; }
  const GroupLaw& law(int group) const { return group_laws[groups[group].law]; }
  const Mat<Pack, Dim>& B_of(int group) const { return B[groups[group].B]; }
  void set_place(int i) const {
    for (int k = 0; k < Dim; ++k) places[k][i] = x[i][k], places[Dim + k][i] = x[i][k] + lead * v[i][k];
  }
  template <class Pass>
  auto with_bonds(const Pass& pass) const {
    if constexpr (Dim == 3)
      if (halved) return pass(halved_bonds);
    return pass(bonds);
  }
};

template <int Dim>
struct alignas(sizeof(Pack)) ShownGroup {
  ShownStress<Pack, Dim> stress;
  Pack energy;  // in J, without interfaces and half cells
};

}  // namespace taut
