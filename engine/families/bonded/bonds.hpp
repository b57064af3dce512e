#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/scene/initial_particles.hpp"

namespace taut {

/// A bond as one of its ends, i, sees it.
struct Bond {
  Point X;        // from i to the other end, m: particle j, or where the bond enters the clamp
  double weight;  // w_ij; 0 where only j asked for the bond
  Point area;     // a_ij = −a_ji, over the share of X_ij before a clamp; in 3D off a lattice of single
                  // precision, in which it is kept
};

/// B a_ij, of B column by column.
inline Point gradient_of(const std::array<Point, 3>& B, const Bond& bond) {
  Point g{};
  for (std::size_t k = 0; k < g.size(); ++k)
    g[k] = B[0][k] * bond.area[0] + B[1][k] * bond.area[1] + B[2][k] * bond.area[2];
  return g;
}

/// What is cancelled at a face besides the bonds, as of one more of particle i, that lies along t.
struct FaceTerm {
  int i;
  Point t;
  double weight;  // w_t
};

struct SolidGeometry;

/// The pairs of particles of one body that act on each other, seen from both sides. They never change: a body
/// that does not break needs no search for neighbours. Held particles are rigid and have no bonds of their
/// own, unless they stand on the face of a clamp.
struct Bonds {
  std::vector<int> begin;  // [n + 1] first bond of each particle
  std::vector<int> j;      // the other particle
  std::vector<Bond> rows;  // of particles, each with its bonds one behind the other
  std::vector<int> row;    // [n] where in `rows` its own begin; −1: `solid` has them; empty: at begin[i]
  std::shared_ptr<const SolidGeometry> solid;  // in 3D
  bool off_lattice =
      false;  // some lie otherwise than on a lattice: how fast their stiffest swing is, is not known
  // of each particle
  std::vector<std::array<Point, 3>>
      B;  // (Σ_j a_ij ⊗ X_ij)⁻¹, column by column; 0 where the bonds lie on a line or nearly
  std::vector<double> volume;        // V, m^dim, with which its energy counts
  std::vector<FaceTerm> face_terms;  // by particle, in 2D
  std::vector<double> mass;          // over the density, m^dim

  /// Bond b, one of those of particle i.
  Bond of(int i, int b) const {
    return row.empty() ? rows[b] : row[i] < 0 ? in_solid(i, b) : rows[row[i] + b - begin[i]];
  }
  /// The face_terms of particle i.
  std::span<const FaceTerm> face_terms_of(int i) const {
    const auto own = std::ranges::equal_range(face_terms, i, {}, &FaceTerm::i);
    return {own.begin(), own.end()};
  }
  /// g_ij = B_i a_ij, 1/m: Σ_j (f_j − f_i) g_ij is the gradient of f at i
  Point gradient(int i, int b) const { return gradient_of(B[i], of(i, b)); }
  /// f(j, bond) of each bond of i
  template <class F>
  void for_each(int i, const F& f) const {
    for (int b = begin[i]; b < begin[i + 1]; ++b) f(j[b], of(i, b));
  }

 private:
  Bond in_solid(int i, int b) const;
};

/// Bonds that sample the strain around a particle evenly in all directions, as near as a layout lets them,
///   Σ_j w_ij e_a e_b e_c e_d = δ_ab δ_cd + δ_ac δ_bd + δ_ad δ_bc,      Σ_j X_ij ⊗ g_ij = I,
/// the first the stiffness of an isotropic solid with λ = μ, the second exact at every particle; changed
/// inside a body by as little as a homogeneous strain there asks for (balance.hpp).
///
/// Which bonds. A particle takes all others within 2h, or, where that leaves no such w_ij ≥ 0, within the
/// least multiple of h/8 up to 3h that does: with h = 0.8 dp the eight nearest on a square lattice and on
/// aligned layers. Where that leaves a pair next to no bond once it is balanced, the body begins with
/// 2.625 h, two spacings: the twelve to fourteen of discs and of irregular layouts. Fewer bonds cost less
/// and, being shorter, sample the strain nearer to their particle. None crosses a slot (neighbors/linked.hpp).
/// A corner has bonds to one side only, of which no choice is right, and comes as near as it can.
///
/// Gradient. a_ij = X_ij/r0⁸ times a constant, before it is balanced: on a lattice nearly the difference of
/// the nearest on the axes, whose strain is that of its own place. With r0⁻⁴ in place of r0⁻⁸ the period of
/// the plate at ten particles across was off by 0.18 %.
///
/// Irregular bodies. Where most free particles have no two others near them that are equally far, to round-off, as
/// of jittered ones, of packings and of a lattice that was written with six digits, bonds reach two spacings from
/// the start. a_ij = X_ij/(1 + (r0/1.3 dp)⁸) sees the nearest alike: with r0⁻⁸ those that are a
/// little nearer count several times as much. At the surface a missing neighbour is a missing bond, as in 3D, and
/// the others have one weight: right weights of bonds to one side are far from even, and a homogeneous strain
/// leaves forces there. The ring mode at
/// dp = 1 mm jittered by 0.1 and 0.2 dp: 0.8 and 2.4 % too slow, with the rules of layers 4.5 and 10 %.
///
/// In 3D bodies are cubic lattices, or layers that are nearly ones, and simpler: a particle takes the 26
/// nearest, with weights (½ + 4t/9, 1 − 8t/9, t) along axes, across faces and across the cube, t = 3/8, and
/// the gradient from those on the axes alone. At a surface a missing neighbour is a missing bond; nothing is
/// balanced. Weights that are right at a surface too bend and twist worse there: they move strain inwards, and
/// edges and corners have none that are right.
///
/// Off a lattice in 3D a particle inside takes the right weights nearest to those, from within 2h or the least
/// multiple of h/8 up to 3h that has any. Of another one weights become less where its bonds would be stiffer in
/// some strain than the solid with λ = μ that they stand for: nowhere may more be cancelled of them than W gives
/// (for ν ≥ 1/4), or the body has no least energy and flies apart. Who has too little of a gradient from the
/// nearest takes it from all its bonds, by r0⁻⁸ as on layers in 2D. A homogeneous strain leaves forces there.
///
/// Clamp. A bond from a free particle into a region that is held, or driven to the end, ends where it meets the region's
/// face. Held on to the held particles themselves, half a spacing behind the face, a cantilever is longer by that half
/// spacing: an error of the period of dp/L, of first order, and the largest there was.
///
/// Volumes. Σ V_i f(X_i) is the midpoint rule, whose error is dp²/24 times the integral of ∂f/∂n over the
/// surface. The volumes contain this end correction, with g_ij for the derivative: about 1.05, 0.94 and 1.01
/// of V0 in the outermost rows. It brings bending, where the outermost particles count most, from an error of
/// the period of 0.57 % at ten particles across to 0.18 %. Masses stay as they are.
/// In 3D it is dp²/15: in a strain that is not homogeneous the bonds store a little less than what is
/// cancelled of them, and for a linear strain that is a surface term as well. An endless square bar of five
/// particles across, bent and twisted, is then off by −0.7 and +1.3 % in its stiffness (ν = 0.4), with 1/24
/// by −2.4 and −0.5 %; of eight by −0.1 and +0.1 %. Masses have the end correction of the midpoint rule
/// there: with equal ones a section's moment of inertia is short by 1/n², and twisting 2 % fast at five
/// particles across. Where particles stand on the faces (Body::on_boundary, 3D) the layout has an end
/// correction already; volumes have −dp²/25 more, with which the square cantilever of six cells across bends
/// in the right time and twists 0.3 % fast. What is held there, in 2D too, keeps its bonds and its energy:
/// the half cells before the clamp are part of the body.
///
/// Faces, in 2D. Where a strain is not homogeneous a bond stores what its middle is strained by, and what is cancelled
/// of it is the mean of its ends, one-sided at a face. Of a strain that is linear over the eight nearest, ε_t along the
/// faces and ε_n across them, the energy is off by G dp²/8 ∮ ∂/∂n (−3/2 ε_t² − ε_t ε_n + 3/2 ε_n²), or at free faces,
/// where ε_n = −ν′ε_t with ν′ = λ/(λ + 2G), by what a face_term takes back:
///   w_t = −c, 6/5 c, −1/5 c of the layers from the outermost one on, c = 5/16 (3/2 − ν′ − 3/2 ν′²) V0/|X|²,
/// times 1.1, since the gradient sees a sixteenth of the diagonals. Along faces only: what is cancelled across them must
/// be that of the bonds, or a homogeneous strain leaves a force. The bending period of five rows was off by +8.2, +2.8
/// and −4.1 % for ν = 0, 0.3 and 0.49, now by +1.5, +0.5 and −2.6 %; at ν = 0.4 c is next to nothing. Not where a body
/// has other bonds than the eight nearest, nor in 3D, where faces are strained along two axes.
Bonds make_bonds(const Scene& scene, const InitialParticles& initial, double h, int threads = 1);

/// The surface that belongs to each particle, S_j = Σ_i (V_i g_ij − V_j g_ji), against which a uniform stress
/// pushes; 0 inside a lattice. Of volumes V, m^dim; of those of the bonds.
std::vector<Point> surface(const Bonds& bonds, const std::vector<double>& V);
inline std::vector<Point> surface(const Bonds& bonds) { return surface(bonds, bonds.volume); }

inline constexpr double least_bond_reach = 2, wide_bond_reach = 2.625;  // in h
inline constexpr double greatest_bond_reach = 3;                        // in h

}  // namespace taut
