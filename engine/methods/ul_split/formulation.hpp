#pragma once

#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut {

enum class Shear : std::uint8_t {
  nested_stress,                       // [Zhang2024] Eq. 7, 13, 14
  laplacian_velocity,                  // ∫ G/ρ ∇²v dt, [Zhang2024] Eq. 19, 20
  laplacian_velocity_nonconservative,  // [Zhang2024] Eq. 18
  nested_with_penalty,                 // [Zhang2024b], [SPHinXsys2025]
};

struct UlSplitSwitches {
  Shear shear = Shear::nested_stress;
  bool central_penalty = false;    // along the line of the pair
  bool artificial_stress = false;  // Gray's
  double epsilon = 0, exponent = 0;
  double beta_least = 1;       // 1: linear, 0: limited; see terms/riemann.hpp
  double cfl_advection = 0.2;  // [Zhang2024] Eq. 21
};

struct UlSplitFormulation : Formulation, UlSplitSwitches {
  static constexpr Family own_family = Family::ul_split;
};

struct UlSplitConstants : Constants {
  double zeta = 0;  // [Zhang2024] Eq. 19
  double xi = 0;
  double penalty_rotation = 0;
  double epsilon = 0, exponent = 0;
  double riemann_limiter = 0, beta_least = 1;
  double pressure_diffusion = 0;
  double cfl_advection = 0;
  double cubic_spline = 0;
  double step_speed = 0;  // m/s
};

/// False if stress is only recovered for snapshots.
constexpr bool carries_stress(const UlSplitFormulation& m) {
  return m.shear == Shear::nested_stress || m.shear == Shear::nested_with_penalty;
}
constexpr bool integrates_shear(const UlSplitFormulation& m) { return m.shear != Shear::nested_stress; }
constexpr bool has_penalty(const UlSplitFormulation& m) { return m.shear == Shear::nested_with_penalty; }

/// Strain of clamped particles keeps `oas` from tearing off at clamps, but would make `enog` too stiff. [Zhang2024]
/// does not specify clamps.
constexpr bool strains_clamped(const UlSplitFormulation& m) { return carries_stress(m); }

constexpr bool consistent(const UlSplitFormulation& m) {
  return (!m.artificial_stress || carries_stress(m)) && (!m.central_penalty || has_penalty(m)) &&
         m.artificial_stress == (m.epsilon > 0) && m.cfl_advection > 0;
}

}  // namespace taut
