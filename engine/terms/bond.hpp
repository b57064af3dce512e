#pragma once

#include <algorithm>
#include <cmath>

#include "engine/core/pack.hpp"
#include "engine/methods/constants.hpp"

/// `oenog`, an objective relative of ENOG that no paper has.
///
/// [Zhang2024] Eq. 20 adds up a shear force along e_ij for each pair, but in axes fixed in space: a stressed
/// body that turns keeps the force of its old attitude. Adding it up for each pair and letting it act along
/// the present e_ij cures that. Since e_ij·v_ij = dr/dt, the sum over time is then a function of r alone,
///   ∫ 2ζG (e·v_ij)/r W′(r0) V_i V_j dt = 2ζG W′(r0) V_i V_j ln(r/r0),
/// so the history is that of a spring, and the whole method can be written as an energy of the positions,
///   E = Σ_i V_i [ G Σ_j w_ij φ(r_ij/r0_ij) + U(J_i) ],   J_i = det F_i,   F_i = Σ_j (x_j − x_i) ⊗ g_ij,
/// whose derivatives are the forces
///   f_i = Σ_j k_ij φ′(λ_ij)/λ_ij (x_j − x_i) + Σ_j (V_i P_i g_ij − V_j P_j g_ji),
///   k_ij = G (V_i w_ij + V_j w_ji)/r0_ij²,   P = U′(J) cof F.
/// What follows from there being an energy that no translation or rotation changes: linear and angular
/// momentum are kept to round-off, a turned body keeps its stress, and the energy is kept as well as the time
/// integrator can. The bonds resist every displacement of a particle against its neighbours: there is no
/// zigzag mode.
///
/// Constants. With Σ_j w e⊗e⊗e⊗e isotropic (engine/bonds.hpp) the bonds have Lamé's constants λ = μ = G, so
/// the volumetric part carries K − 5G/3, for the in-plane modulus λ = K − 2G/3 of plane strain. φ and U are
/// chosen so that the energy of plane strain equals the neo-Hookean
///   W = G/2 (J^(−2/3) tr C − 3) + K/2 (J − 1)²
/// up to third order in the strain. With the Green strain E = m I + deviator of eigenvalues ±d, ⟨⟩ the mean
/// over directions, q = e·E·e and φ = q²/2 + a q³/6, it is
///   bonds   8G⟨φ⟩ = 4G m² + 2G d² + 4Ga/3 m³ + 2Ga m d²,
///   U       K′/2 (J−1)² + k₃/6 (J−1)³ = 2K′ m² − 4K′ m d² + 4k₃/3 m³ + …,
///   W       (2G/3 + 2K) m² + 2G d² − 40G/27 m³ − (8G + 4K) m d² + …,
/// hence K′ = K − 5G/3, a = −22/3, k₃ = 56G/9.
///
/// Of the laws with these two derivatives φ is the one of λ², 1/λ² and 1/λ⁴: a force without a root and with
/// one division, a slope that rises for every λ, and no end to it as λ → 0. Where J = 1 it is right to the
/// fourth order too (φ⁗ = 208/3 in q): in shear the energy is the neo-Hookean one up to the fifth order.
/// Also tried: 5/36 (λ − 1)² + 13/36 (1 − 1/λ)², third order only, with a root and two divisions.
namespace taut::inline TAUT_ISA {

/// φ = (7 λ² + 3/λ² + 2/λ⁴ − 12)/72, of t = 1/λ² = r0²/r²
template <class T>
T bond_energy(const T& t) {
  return (7 / t + t * (3 + 2 * t) - 12) / 72;
}

/// φ′(λ)/λ of t = 1/λ²: times k (x_j − x_i) with k = G (V_i w_ij + V_j w_ji)/r0² it is the force on i.
template <class T>
T bond_slope(const T& t) {
  return 7.0 / 36 - t * t * (3.0 / 36 + 4.0 / 36 * t);
}

/// φ″(λ) of t = 1/λ²: 1 at rest, 4.1 at λ = 3/4. What a bond resists its own stretch with.
inline double bond_stiffness(double t) { return (14 + t * t * (18 + 40 * t)) / 72; }

/// m/s, of compression in plane strain and in 3D
inline double compression_wave_speed(const Elasticity& m) {
  return std::sqrt((m.K + 4.0 / 3 * m.G) / m.rho0);
}

/// The volumetric part U(J): K′/2 (J − 1)² + k₃/6 (J − 1)³, and for J < 1 a fourth-order term that keeps a
/// particle from being pressed to nothing or turned inside out,
///   −(K′ + k₃) (ln J − 3J + 3J²/2 − J³/3 + 11/6),   of slope −(K′ + k₃) (1 − J)³/J.
struct Volumetric {
  double K, k3;  // Pa

  Volumetric(double bulk_modulus, double G) : K(bulk_modulus - 5.0 / 3 * G), k3(56.0 / 9 * G) {}

  static constexpr double least = 0.05;  // J below is taken for this: the slope stays finite

  double energy(double J) const {  // Pa
    const double x = J - 1, c = std::max(J, least);
    const double barrier =
        J < 1 ? -(K + k3) * (std::log(c) - 3 * c + 1.5 * c * c - c * c * c / 3 + 11.0 / 6) : 0;
    return x * x * (K / 2 + k3 / 6 * x) + barrier;
  }
  double slope(double J) const {  // Pa
    const double x = J - 1, shut = std::max(-x, 0.0);
    return x * (K + k3 / 2 * x) - (K + k3) * shut * shut * shut / std::max(J, least);
  }
};

}  // namespace taut::inline TAUT_ISA
