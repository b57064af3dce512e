#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/methods/bonded/layout/constraints.hpp"
#include "engine/methods/constants.hpp"

namespace taut {

struct ReferenceBond {
  Point X;        // from i to j or to the face of a clamp, m
  double weight;  // w_ij; 0 if only j selected the bond
  Point area;     // a_ij = −a_ji; off-lattice in 3D rounded to float
};

/// B = (Σ_j a_ij ⊗ X_ij)⁻¹, column by column.
using InverseMoment = std::array<Point, 3>;

/// g_ij = B a_ij, 1/m.
inline Point gradient_of(const InverseMoment& B, const ReferenceBond& bond) {
  Point g{};
  for (std::size_t k = 0; k < g.size(); ++k)
    g[k] = B[0][k] * bond.area[0] + B[1][k] * bond.area[1] + B[2][k] * bond.area[2];
  return g;
}

/// Term cancelled like one more bond along t (THEORY.md, Faces).
struct FaceTerm {
  int i;
  Point t;
  double weight;  // w_t
};

struct SolidGeometry;

/// Bonds inside bodies, stored at both ends. Rigid particles store none, except in bodies with `on_boundary`.
struct Bonds {
  std::vector<int> begin;           // [n + 1] first bond
  std::vector<int> j;               // [bond]
  std::vector<ReferenceBond> rows;  // contiguous per particle
  std::vector<int> row;             // [n] first in `rows`; −1: computed by `solid`; empty: as `begin`
  std::shared_ptr<const SolidGeometry> solid;  // in 3D
  bool off_lattice = false;
  Constraints constraints;           // [n]
  std::vector<InverseMoment> B;      // [n]; 0 where bonds hardly span the space
  std::vector<double> volume;        // [n] V, m^dim, weight of the strain energy
  std::vector<double> mass;          // [n] mass over density, m^dim
  std::vector<FaceTerm> face_terms;  // sorted by particle; in 2D

  int size() const { return static_cast<int>(begin.size()) - 1; }
  bool is_rigid(int i) const { return taut::is_rigid(constraints[i]); }
  /// Bond b must belong to particle i.
  ReferenceBond of(int i, int b) const {
    return row.empty() ? rows[b] : row[i] < 0 ? in_solid(i, b) : rows[row[i] + b - begin[i]];
  }
  std::span<const FaceTerm> face_terms_of(int i) const {
    return {std::ranges::lower_bound(face_terms, i, {}, &FaceTerm::i),
            std::ranges::upper_bound(face_terms, i, {}, &FaceTerm::i)};
  }
  /// g_ij, 1/m.
  Point gradient(int i, int b) const { return gradient_of(B[i], of(i, b)); }
  template <class F>
  void for_each(int i, const F& f) const {
    for (int b = begin[i]; b < begin[i + 1]; ++b) f(j[b], of(i, b));
  }

 private:
  ReferenceBond in_solid(int i, int b) const;
};

Bonds make_bonds(const Scene& scene, const InitialParticles& initial, Constraints constraints, double h,
                 int threads = 1);
inline Bonds make_bonds(const Scene& scene, const InitialParticles& initial, double h) {
  return make_bonds(scene, initial, make_constraints(scene, initial), h);
}

/// Modulus of bonds, at most G, in Pa (terms/bond.hpp).
double modulus_of_bonds(int dim, const Elasticity& m);
/// Harmonic mean of G at both ends, Pa. A rigid j counts like i.
double modulus_of_bond(const Bonds& bonds, const InitialParticles& initial,
                       const std::vector<Elasticity>& materials, int i, int b);

/// S_j for the volumes V (THEORY.md, Volumes and masses).
std::vector<Point> surface(const Bonds& bonds);

inline constexpr double least_bond_reach = 2, wide_bond_reach = 2.625;  // in h
inline constexpr double greatest_bond_reach = 3;                        // in h

}  // namespace taut
