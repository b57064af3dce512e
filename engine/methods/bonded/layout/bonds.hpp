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

/// Seen from its end i.
struct ReferenceBond {
  Point X;        // m; to j or the clamp's face
  double weight;  // w_ij; 0 if selected by j only
  Point area;     // a_ij = −a_ji over the share of X_ij; off-lattice 3D: float
};

/// B = (Σ_j a_ij ⊗ X_ij)⁻¹ by columns.
using InverseMoment = std::array<Point, 3>;

/// g_ij = B a_ij, 1/m.
inline Point gradient_of(const InverseMoment& B, const ReferenceBond& bond) {
  Point g{};
  for (std::size_t k = 0; k < g.size(); ++k)
    g[k] = B[0][k] * bond.area[0] + B[1][k] * bond.area[1] + B[2][k] * bond.area[2];
  return g;
}

/// Cancelled by particle i like a bond along t (THEORY.md, Faces).
struct FaceTerm {
  int i;
  Point t;
  double weight;  // w_t
};

struct SolidGeometry;

/// Pairs of one body, seen from both ends. Clamped particles have no bonds except on a clamp's face.
struct Bonds {
  std::vector<int> begin;                      // [n + 1]
  std::vector<int> j;                          // neighbour
  std::vector<ReferenceBond> rows;             // contiguous per particle
  std::vector<int> row;                        // [n]; −1: use `solid`; empty: as `begin`
  std::shared_ptr<const SolidGeometry> solid;  // in 3D
  bool off_lattice = false;                    // estimate the highest frequency
  Constraints constraints;                     // [n]
  std::vector<InverseMoment> B;                // [n]; 0 if collinear
  std::vector<double> volume;                  // [n] m^dim, for energy
  std::vector<double> mass;                    // [n] m^dim, over density
  std::vector<FaceTerm> face_terms;            // sorted by particle; 2D

  int size() const { return static_cast<int>(begin.size()) - 1; }
  bool is_rigid(int i) const { return taut::is_rigid(constraints[i]); }
  /// Bond b of particle i.
  ReferenceBond of(int i, int b) const {
    return row.empty() ? rows[b] : row[i] < 0 ? in_solid(i, b) : rows[row[i] + b - begin[i]];
  }
  std::span<const FaceTerm> face_terms_of(int i) const {
    return {std::ranges::lower_bound(face_terms, i, {}, &FaceTerm::i),
            std::ranges::upper_bound(face_terms, i, {}, &FaceTerm::i)};
  }
  /// g_ij, 1/m: ∇f = Σ_j (f_j − f_i) g_ij.
  Point gradient(int i, int b) const { return gradient_of(B[i], of(i, b)); }
  /// Calls f(j, bond).
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

/// G in bonds, Pa (terms/bond.hpp).
double modulus_of_bonds(int dim, const Elasticity& m);
/// G of bond b, Pa: harmonic mean, as springs in series. Rigid ends take the other's.
double modulus_of_bond(const Bonds& bonds, const InitialParticles& initial,
                       const std::vector<Elasticity>& materials, int i, int b);

/// S_j = Σ_i (V_i g_ij − V_j g_ji); 0 inside a lattice.
std::vector<Point> surface(const Bonds& bonds);

inline constexpr double least_bond_reach = 2, wide_bond_reach = 2.625;  // in h
inline constexpr double greatest_bond_reach = 3;                        // in h

}  // namespace taut
