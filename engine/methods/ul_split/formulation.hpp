#pragma once

#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut {

/// How the shear stress acts on the velocity.
enum class Shear : std::uint8_t {
  nested_stress,       // ∇·s, s from the Jaumann rate of the velocity gradient; [Zhang2024] Eq. 7, 13, 14
  laplacian_velocity,  // ∫ G/ρ ∇²v dt with the angular-momentum-conserving operator; [Zhang2024] Eq. 19, 20
  laplacian_velocity_nonconservative,  // the same with the plain operator; [Zhang2024] Eq. 18
};

struct UlSplitSwitches {
  Shear shear = Shear::nested_stress;
  bool artificial_stress = false;    // Gray's
  double epsilon = 0, exponent = 0;  // of the same
  double beta_least = 1;       // of the dissipation in P*: 1 = linear, 0 = limited; see terms/riemann.hpp
  double cfl_advection = 0.2;  // [Zhang2024] Eq. 21
};

struct UlSplitFormulation : Formulation, UlSplitSwitches {
  static constexpr Family own_family = Family::ul_split;
};

struct UlSplitConstants : Constants {
  double zeta = 0;                             // factor of the Laplacian, [Zhang2024] Eq. 19
  double epsilon = 0, exponent = 0;            // artificial stress
  double riemann_limiter = 0, beta_least = 1;  // β = min(max(limiter · (U_L − U_R)/c0, β_least), 1)
  double pressure_diffusion = 0;               // share of (p_i − p_j)/(2 ρ0 c0) in U*: 0 or 1
  double cfl_advection = 0;
  double step_speed = 0;  // m/s, which steps follow
};

/// The stress that a method keeps for each particle is one that it computes with (true), or one that is only recovered to
/// be shown (false).
constexpr bool carries_stress(const UlSplitFormulation& m) { return m.shear == Shear::nested_stress; }

/// Held particles of a method with stress are strained by the others, so that the stress is continuous across
/// the clamp: with an unstrained clamp `oas` tears off it. Those of the other methods are rigid, their
/// density stays: strained, `enog` would be stiffer at the clamp and not converge to the period of the plate.
/// [Zhang2024] does not say.
constexpr bool strains_what_is_held(const UlSplitFormulation& m) { return carries_stress(m); }

constexpr bool consistent(const UlSplitFormulation& m) {
  return (!m.artificial_stress || carries_stress(m)) &&  // the stress that it would be taken from
         m.artificial_stress == (m.epsilon > 0) && m.cfl_advection > 0;
}

}  // namespace taut
