#pragma once

#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"

namespace taut {

/// Stress term of a pair in (1/ρ) ∇·σ.
enum class PairStress : std::uint8_t {
  product,  // m_j (σ_i + σ_j)/(ρ_i ρ_j), [Khayyer2024] Eq. 9
  squares,  // m_j (σ_i/ρ_i² + σ_j/ρ_j²), [TranDuc2023] Eq. 2.3
};

enum class Continuity : std::uint8_t {
  velocity_gradient,  // −ρ tr ∇û, [Khayyer2024] Eq. 8, 29
  masses,             // Σ m_j u_ij·∇W, [TranDuc2023] §2.2
};

enum class Viscosity : std::uint8_t {
  none,
  artificial,  // [Khayyer2024] Eq. 15, 16
  riemann,     // second-order Riemann problem, [Khayyer2024] Eq. 39–45
};

struct UlCauchySwitches {
  bool artificial_stress = false;    // Gray's
  double epsilon = 0, exponent = 0;  // of the artificial stress
  PairStress pair_stress = PairStress::product;
  Continuity continuity = Continuity::velocity_gradient;
  Viscosity viscosity = Viscosity::none;
  bool corrected = false;           // kernel gradients, [Khayyer2024] Eq. 27–31
  bool transport_velocity = false;  // XSPH, [Khayyer2024] Eq. 14
  bool density_diffusion = false;   // [Khayyer2024] Eq. 32–35
  bool tensile_control = false;     // TIC inside, artificial stress at surfaces, [Khayyer2024] §3.4
};

struct UlCauchyFormulation : Formulation, UlCauchySwitches {
  static constexpr Family own_family = Family::ul_cauchy;
};

struct UlCauchyConstants : Constants {
  double alpha = 0;           // of the artificial viscosity
  double riemann_factor = 0;  // factor of the dissipation
  double limiter = 0;         // Limiter of its reconstruction
  double geometry = 0;        // evaluates ∇u at 0: start, 1: end of the step
  double xsph = 0;            // ε of XSPH
  double delta = 0;           // of the density diffusion
  double epsilon = 0, exponent = 0;
  double surface_colour = 0;             // a particle with a lower colour function is at the surface
  double vicinity = 0;                   // of a surface, in spacings
  double surface_artificial_stress = 0;  // share of artificial stress without TIC
  double step_speed = 0;                 // wave speed for steps, m/s
};

constexpr bool carries_stress(const UlCauchyFormulation&) { return true; }

constexpr bool consistent(const UlCauchyFormulation& m) {
  // second-order terms need corrected gradients
  const bool second_order = m.density_diffusion || m.viscosity == Viscosity::riemann || m.tensile_control;
  return m.artificial_stress == (m.epsilon > 0) && (m.corrected || !second_order) &&
         (!m.tensile_control || m.artificial_stress) &&           // TIC keeps it at surfaces
         (m.pair_stress == PairStress::product || !m.corrected);  // not in any paper
}

}  // namespace taut
