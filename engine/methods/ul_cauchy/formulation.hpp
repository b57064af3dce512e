#pragma once

#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut {

/// Pair term in (1/ρ) ∇·σ.
enum class PairStress : std::uint8_t {
  product,  // [Khayyer2024] Eq. 9
  squares,  // [TranDuc2023] Eq. 2.3
};

enum class Continuity : std::uint8_t {
  velocity_gradient,  // [Khayyer2024] Eq. 8, 29
  masses,             // [TranDuc2023] §2.2
};

enum class Viscosity : std::uint8_t {
  none,
  artificial,  // [Khayyer2024] Eq. 15, 16
  riemann,     // [Khayyer2024] Eq. 39–45
};

struct UlCauchySwitches {
  bool artificial_stress = false;  // Gray's
  double epsilon = 0, exponent = 0;
  PairStress pair_stress = PairStress::product;
  Continuity continuity = Continuity::velocity_gradient;
  Viscosity viscosity = Viscosity::none;
  bool corrected = false;           // kernel gradients, [Khayyer2024] Eq. 27–31
  bool transport_velocity = false;  // XSPH, [Khayyer2024] Eq. 14
  bool density_diffusion = false;   // [Khayyer2024] Eq. 32–35
  bool tensile_control = false;     // [Khayyer2024] §3.4
};

struct UlCauchyFormulation : Formulation, UlCauchySwitches {
  static constexpr Family own_family = Family::ul_cauchy;
};

struct UlCauchyConstants : Constants {
  double alpha = 0;
  double riemann_factor = 0;
  double limiter = 0;   // Limiter
  double geometry = 0;  // positions for ∇u; 0: start, 1: end of the step
  double xsph = 0;
  double delta = 0;
  double delta_order = 1;  // factor of ∇ρ in ψ
  double epsilon = 0, exponent = 0;
  double repulsion_weight = 0;  // RepulsionWeight
  double surface_colour = 0;
  double vicinity = 0;  // in spacings
  double surface_artificial_stress = 0;
  double step_speed = 0;  // m/s
};

/// [TranDuc2023] and [Khayyer2024] print different weights f_ij.
constexpr bool chooses_repulsion_weight(const UlCauchyFormulation& m) {
  return m.artificial_stress && m.pair_stress == PairStress::squares;
}

constexpr bool carries_stress(const UlCauchyFormulation&) { return true; }

constexpr bool consistent(const UlCauchyFormulation& m) {
  const bool second_order = m.density_diffusion || m.viscosity == Viscosity::riemann || m.tensile_control;
  return m.artificial_stress == (m.epsilon > 0) && (m.corrected || !second_order) &&
         (!m.tensile_control || m.artificial_stress) &&           // artificial stress acts at surfaces
         (m.pair_stress == PairStress::product || !m.corrected);  // no paper corrects `squares`
}

}  // namespace taut
