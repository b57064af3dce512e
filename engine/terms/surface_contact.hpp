#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/pack.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// Contact pressure per depth, Pa/m; M = K + 4G/3. With stiffness = 2 the overlap is the compression of one spacing of
/// each material. Symmetric to the last bit.
inline double surface_stiffness(double M1, double M2, double stiffness, double dp) {
  const double softer = std::min(M1, M2), harder = std::max(M1, M2);
  return 0.5 * stiffness * (softer * (harder / (softer + harder))) / dp;
}

/// Derivative by M2, 1/m.
inline double surface_stiffness_slope(double M1, double M2, double stiffness, double dp) {
  const double share = M1 / (M1 + M2);
  return 0.5 * stiffness * share * share / dp;
}

/// Contact stiffness relative to the material, at least 1.
inline double stiffer_than_material(double stiffness) { return std::max(1.0, stiffness / 2); }

/// Energy in J of a piece of a face at `depth` behind another face; each face contributes half.
inline double surface_energy(double depth, double area, double k) {
  return depth > 0 ? 0.25 * k * area * depth * depth : 0;
}

/// Separating force, N: the slope of surface_energy.
inline double surface_force(double depth, double area, double k) {
  return depth > 0 ? 0.5 * k * area * depth : 0;
}

inline double smooth_step(double u) { return u * u * (3 - 2 * u); }

/// c, the share of a face at height p, 0 from `reach` (m) on.
inline double near_share(double p, double reach, double fade = 0.3) {
  return smooth_step(std::clamp((1 - std::abs(p) / reach) / fade, 0.0, 1.0));
}
inline double near_slope(double p, double reach, double fade = 0.3) {  // 1/m
  const double t = std::clamp((1 - std::abs(p) / reach) / fade, 0.0, 1.0);
  return (p < 0 ? 1 : -1) * 6 / (fade * reach) * t * (1 - t);
}

inline constexpr double fade_2d = 1.0 / 6;  // fades from 1 to 1.2 spacings
/// Energy in J that fades to 0 at `reach`.
inline double near_energy(double depth, double area, double k, double reach) {
  return near_share(depth, reach, fade_2d) * surface_energy(depth, area, k);
}
inline double near_force(double depth, double area, double k, double reach) {  // its slope, N
  return near_share(depth, reach, fade_2d) * surface_force(depth, area, k) +
         near_slope(depth, reach, fade_2d) * surface_energy(depth, area, k);
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

/// Weight of a piece of a face. `cosine`: of the angle between the outward normals.
inline double facing_share(double cosine) { return std::clamp(-4 * cosine - 1, 0.0, 1.0); }
inline double facing_slope(double cosine) { return cosine > -0.5 && cosine < -0.25 ? -4 : 0; }

// THEORY.md explains the depth of facets in 3D.

/// Lateral range R, m. A smaller range lets edges through.
inline double lateral_radius(double p, double dp) {
  const double t = std::clamp(-p / dp, 0.0, 1.0);
  return (1.5 - 0.45 * t * t * (3 - 2 * t)) * dp;
}
inline double lateral_radius_slope(double p, double dp) {  // dR/dp
  const double t = std::clamp(-p / dp, 0.0, 1.0);
  return 0.45 * 6 * t * (1 - t);
}

/// Lateral weight w, 1/m²; ∫ w dA = 1.
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

/// Energy in J whose stiffness grows with the depth, since the pressure under an edge is unbounded.
inline double hard_energy(double depth, double area, double k, double dp) {
  const double u = depth / dp;
  return (1 + u * u) * surface_energy(depth, area, k);
}
inline double hard_force(double depth, double area, double k, double dp) {
  const double u = depth / dp;
  return (1 + 2 * u * u) * surface_force(depth, area, k);
}
/// s, the share projected on the normal of the other face.
inline double projected_share(double cosine) { return -cosine * facing_share(cosine); }
inline double projected_slope(double cosine) { return -facing_share(cosine) - cosine * facing_slope(cosine); }

/// Factor of the energy. `cover` = Σ_g W.
inline double covered_share(double cover) {
  const double t = std::clamp((cover - 0.15) / 0.7, 0.0, 1.0);
  return smooth_step(t);
}
inline double covered_slope(double cover) {
  const double t = std::clamp((cover - 0.15) / 0.7, 0.0, 1.0);
  return 6 / 0.7 * t * (1 - t);
}

inline double covered_second_derivative(double cover) {
  const double t = (cover - 0.15) / 0.7;
  return t > 0 && t < 1 ? 6 / 0.49 * (1 - 2 * t) : 0;
}

/// Bound of the stiffness relative to its value at first touch, ½ k A (THEORY.md).
inline double hardening(double depth, double cover, double dp) {
  constexpr double soon = 0.1, first = 0.2, steepest = 1.2, bend = 4;
  if (cover < soon) return 1;
  const double u2 = depth * depth / (dp * dp), W = std::max(cover, first), slope = covered_slope(W);
  return (1 + 6 * u2) * covered_share(W) + 4 * depth / dp * (1 + 2 * u2) * slope * steepest +
         u2 * (1 + u2) * (std::abs(covered_second_derivative(W)) * steepest * steepest + slope * bend);
}

}  // namespace taut
