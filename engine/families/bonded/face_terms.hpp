#pragma once

#include <vector>

#include "engine/scene/initial_particles.hpp"

namespace taut {

struct Bonds;
class SolidBonds;

/// What is cancelled at a face besides the bonds, of particle i: as of one more bond along d or, where it is `across`,
/// of the areas across d, whose s° is d·(cof C) d / d² (terms/bond.hpp).
struct FaceTerm {
  int i;
  Point d;
  double weight;
  bool across = false;
};

/// What bonds lack at the free faces of a body, by particle. Where a strain is not homogeneous a bond stores what its
/// middle is strained by, and what is cancelled of it is the mean of its ends, one-sided at a face. Of a strain that
/// is linear over a particle's bonds that leaves an error of the energy, G dp² ∮ ∂/∂n of a quadratic form of the
/// strain, or at free faces, where that across them follows from those along them by ν′ = λ/(λ + 2G), of those along
/// them alone. It is taken back there by terms of the three outermost layers, whose weights add up to 0: nothing of a
/// homogeneous strain. Along faces only: what is cancelled across them must be that of the bonds, or a homogeneous
/// strain leaves a force.
///
/// In 2D the form is (−3/2 ε_t² − ε_t ε_n + 3/2 ε_n²)/8, and the weights along the face, X to the second layer,
///   −c, 6/5 c, −1/5 c with c = 1.1 · 5/16 (3/2 − ν′ − 3/2 ν′²) V0/|X|²;
/// 1.1, since the gradient sees a sixteenth of the diagonals. The bending period of five rows was off by +8.2, +2.8
/// and −4.1 % for ν = 0, 0.3 and 0.49, now by +1.5, +0.5 and −2.6 %; at ν = 0.4 c is next to nothing. Of bodies of the
/// eight nearest, at particles that have five of them.
///
/// In 3D volumes have the end correction of 1/15 (bonds.hpp). Of curvatures whose two strains are opposite 1/12 would
/// be right at any ν, and (3 + 2ν′ − 9ν′²)/(24 (1 + 2ν′)) of those that are equal: hence along the two axes of the face
/// and along its two diagonals, which are stretched by tr² + 2 ε:ε, and of its areas, which are by tr²,
///   −1/8, 13/60, −11/120    and    −2c, 3c, −c with c = (1 − 5ν′)(1 + 3ν′)/40.
/// The first moments of these weights are what is lacking; the second one of the lines is such that an endless plate
/// twists as it should with any number of layers, that of the areas puts the slope at the face itself. Free plates of
/// ten thicknesses, three and five layers: periods were off by up to 8.4 and 2.9 % (ν = 0 to 0.49), now by up to 1.5
/// and 0.6 %. Of cubic lattices whose particles stand in the middle of their cells, where seventeen of the 26 nearest
/// are there and the edges of the face at least as far as the face behind: nearer to them strains vary along the face
/// too. With terms up to its edges a square bar of ten particles across twists 0.3 % too fast, without 0.04 %.
///
/// `surface`: S_j (bonds.hpp), outwards; `uncut`: bonds as if nothing were held.
std::vector<FaceTerm> face_terms(const Scene& scene, const InitialParticles& initial, const Bonds& uncut,
                                 const std::vector<Point>& surface);
std::vector<FaceTerm> face_terms(const Scene& scene, const InitialParticles& initial, const SolidBonds& uncut,
                                 const std::vector<Point>& surface);

}  // namespace taut
