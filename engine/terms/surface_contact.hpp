#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/pack.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// Pressure per depth between two faces, Pa/m, of two materials whose moduli of compression are M = K + 4G/3:
/// k = ½ s M1 M2/(M1 + M2)/dp. With s = 2 faces under a pressure p overlap by as much as it presses a layer
/// of two spacings of the material. Stiffer is nearer to the truth, which has no overlap, and would ask for
/// shorter steps: the fastest motion of two faces of `oenog` in 2D, whose outermost particles weigh 3/2 and
/// −1/2 in a node, has ω = 2.1 c_p/dp for s = 2, 2.6 for 4 and 3.1 for 6, which is where its steps of 0.64 dp/c_p end
/// to be stable. The energy of two rings that collide undamped drifts by 0.1 % for 2 at 2 mm, by 0.5 % for 4.
/// Symmetric to the last bit.
inline double surface_stiffness(double M1, double M2, double stiffness, double dp) {
  const double softer = std::min(M1, M2), harder = std::max(M1, M2);
  return 0.5 * stiffness * (softer * (harder / (softer + harder))) / dp;
}

/// Its slope in M2, 1/m.
inline double surface_stiffness_slope(double M1, double M2, double stiffness, double dp) {
  const double share = M1 / (M1 + M2);
  return 0.5 * stiffness * share * share / dp;
}

/// Ratio of the stiffness of a contact with this factor s to the stiffness of the material, 1 at least.
inline double stiffer_than_material(double stiffness) { return std::max(1.0, stiffness / 2); }

/// J (per metre depth in 2D), of a piece of a face, m (m² in 3D), that lies `depth`, m, behind another face:
/// ½ · ½ k δ² A. Of two faces that overlap each is seen from the other, and each counts for half.
inline double surface_energy(double depth, double area, double k) {
  return depth > 0 ? 0.25 * k * area * depth * depth : 0;
}

/// Its slope, N (per metre depth in 2D), ½ k δ A: it pushes the piece out of the other face and the other face
/// back, 0 where they do not overlap.  Ours
inline double surface_force(double depth, double area, double k) {
  return depth > 0 ? 0.5 * k * area * depth : 0;
}
inline constexpr ContactLawRow surface_contact{
    .law = ContactLaw::surface,
    .help = "spring between overlapping faces; own law of taut",
    .term =
        {"contact",
         "f = ½ k δ A on a piece of a face δ behind another face, k = ½ s M1 M2/(M1 + M2)/dp, M = K + 4G/3",
         "ours", "terms/surface_contact.hpp:surface_force",
         "surface contact: the force is zero before faces meet and then the slope of the energy"},
    .between = ContactBetween::faces,
    .touching = 0,
};

/// Share of a piece of a face that counts, of the cosine between its outward normal and that of the face it
/// lies behind: all of it up to 60° from facing it, none from 76° on. At a corner one side meets a face and
/// the other one, at 90° or a little less once it is strained, does not.
inline double facing_share(double cosine) { return std::clamp(-4 * cosine - 1, 0.0, 1.0); }
inline double facing_slope(double cosine) { return cosine > -0.5 && cosine < -0.25 ? -4 : 0; }

// In 3D the depth of a piece f of a face, a facet, behind another face is a mean over facets g of that face,
//
//   δ = −Σ_g W p / Σ_g W,   p = (x_f − x_g) · (n_g − n_f)/|n_g − n_f|,   W = A_g s(n_f · n_g) w(ℓ²) c(p),
//
// with the height p over the plane half way between the two, the same seen from both, the projected share s, a
// weight w of the distance ℓ beside each other, ℓ² = |x_f − x_g|² − p², within a radius R(p), and a share c of those
// that are not too far off. What lies deep counts only where it overlaps: beside a step as high as the spacing the
// rim above is no face that the foot of a body lies behind.
//
// With ½ (n_g − n_f) in p a facet that tilts would lie less deep, and edges that press each other would
// turn out of each other's way. On two flat faces that are parallel δ is the exact depth, on round ones but for
// terms of the third order; it turns with the bodies and is smooth where faces are, so that the force may be the
// slope of the energy to the last term: both momenta and the energy hold, and what is symmetric stays so. A
// nearest point jumps from facet to facet, and with it the force.
//
// Σ_g W covers f whole, 1, in the middle of the other face and half of it over its rim; `covered_share` of
// the energy counts.  Ours

/// R, m, of the height p, m: 1.5 spacings above, 1.05 from a depth of one spacing on. Less lets edges and corners
/// through (0.85: 24 of 60 pairs of tilted boxes), more sees the rim of a step.
inline double lateral_radius(double p, double dp) {
  const double t = std::clamp(-p / dp, 0.0, 1.0);
  return (1.5 - 0.45 * t * t * (3 - 2 * t)) * dp;
}
inline double lateral_radius_slope(double p, double dp) {  // dR/dp
  const double t = std::clamp(-p / dp, 0.0, 1.0);
  return 0.45 * 6 * t * (1 - t);
}

/// w, 1/m², of which ∫ w dA is 1, of the distance ℓ < radius, m.
inline double lateral_weight(double l2, double radius) {
  const double u = 1 - l2 / (radius * radius);
  return u > 0 ? 3 / (std::numbers::pi * radius * radius) * u * u : 0;
}
inline double lateral_slope(double l2, double radius) {  // dw/dℓ², 1/m⁴
  const double square = radius * radius, u = 1 - l2 / square;
  return u > 0 ? -6 / (std::numbers::pi * square * square) * u : 0;
}
inline double lateral_slope_in_radius(double l2, double radius) {  // dw/dR, 1/m³
  const double square = radius * radius, u = 1 - l2 / square;
  return u > 0 ? 6 / (std::numbers::pi * square * radius) * u * (2 - 3 * u) : 0;
}

/// In 3D a depth that nears the spacing is resisted the more: ½ · ½ k δ² (1 + δ²/dp²) A. Under an edge the pressure
/// has no bound that the spacing would not exceed.
inline double hard_energy(double depth, double area, double k, double dp) {
  const double u = depth / dp;
  return (1 + u * u) * surface_energy(depth, area, k);
}
inline double hard_force(double depth, double area, double k, double dp) {
  const double u = depth / dp;
  return (1 + 2 * u * u) * surface_force(depth, area, k);
}
/// s: as `facing_share`, of the area that a facet has across the other normal. The faces of an edge or a corner
/// that meet another face together press no harder than one that is flat.
inline double projected_share(double cosine) { return -cosine * facing_share(cosine); }
inline double projected_slope(double cosine) { return -facing_share(cosine) - cosine * facing_slope(cosine); }

/// c, of a height p, m, over or behind, up to the reach, m: all of it up to 0.7 of the reach.
inline double near_share(double p, double reach) {
  const double t = std::clamp((1 - std::abs(p) / reach) / 0.3, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}
inline double near_slope(double p, double reach) {  // 1/m
  const double t = std::clamp((1 - std::abs(p) / reach) / 0.3, 0.0, 1.0);
  return (p < 0 ? 1 : -1) * 6 / (0.3 * reach) * t * (1 - t);
}

/// All of it from a cover of 0.85 on, so that a face of uneven facets counts whole.
inline double covered_share(double cover) {
  const double t = std::clamp((cover - 0.15) / 0.7, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}
inline double covered_slope(double cover) {
  const double t = std::clamp((cover - 0.15) / 0.7, 0.0, 1.0);
  return 6 / 0.7 * t * (1 - t);
}

inline double covered_bend(double cover) {
  const double t = (cover - 0.15) / 0.7;
  return t > 0 && t < 1 ? 6 / 0.49 * (1 - 2 * t) : 0;
}

/// How stiff that energy is in where a facet is, over what it is at first touch, ½ k A: in its depth, and, as edges
/// and corners slip past each other, in its cover, which changes by less than 1.2 a spacing, its slope by some 4;
/// twice, since facets share their nodes. A cover that is about to count, too. With the first part alone some
/// pairs of tilted boxes doubled their energy in passing.
inline double hardening(double depth, double cover, double dp) {
  constexpr double soon = 0.1, first = 0.2, steepest = 1.2, bend = 4;
  if (cover < soon) return 1;
  const double u2 = depth * depth / (dp * dp), W = std::max(cover, first), slope = covered_slope(W);
  return (1 + 6 * u2) * covered_share(W) + 4 * depth / dp * (1 + 2 * u2) * slope * steepest +
         u2 * (1 + u2) * (std::abs(covered_bend(W)) * steepest * steepest + slope * bend);
}

}  // namespace taut
