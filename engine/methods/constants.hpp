#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace taut {

inline constexpr std::size_t most_law_parameters = 4;

/// The numbers of a material.
struct Elasticity {
  double rho0 = 0;                                   // kg/m³
  double c0 = 0;                                     // sound speed √(K/ρ0), m/s, [Zhang2024] Eq. 5
  double K = 0, G = 0;                               // bulk and shear modulus, Pa
  std::array<double, most_law_parameters> of_law{};  // those of LawRow::parameters, in that order
};

/// m/s, of compression in plane strain and in 3D
inline double compression_wave_speed(const Elasticity& m) {
  return std::sqrt((m.K + 4.0 / 3 * m.G) / m.rho0);
}

/// The numbers of one run of a method. SI units. Those of the material are of the only one; where there are
/// several, of the first body's, with the greatest sound speed of all.
struct Constants : Elasticity {
  double dp = 0;                               // particle spacing, m
  double h = 0;                                // smoothing length, m
  double zeta = 0;                             // factor of the Laplacian, [Zhang2024] Eq. 19
  double epsilon = 0, exponent = 0;            // artificial stress
  double riemann_limiter = 0, beta_least = 1;  // β = min(max(limiter · (U_L − U_R)/c0, β_least), 1)
  double pressure_diffusion = 0;               // share of (p_i − p_j)/(2 ρ0 c0) in U*: 0 or 1
  double contact_stiffness = 1;                // over K1 K2/(K1 + K2), see terms/
  double alpha = 0;                            // artificial viscosity
  double xsph = 0;                             // share of the mean velocity around in the transport velocity
  double damping = 0;                          // of bonds: τ over dp √(ρ0/G) of the fastest material
  double geometry = 0;                         // where in the step ∇u is taken: 0 its start, 1 its end
  double delta = 0;                            // density diffusion
  double riemann_factor = 0;                   // dissipation of the second-order Riemann term
  double surface_colour = 0;                   // colour function below which a particle is of the surface
  double vicinity = 0;                         // reach of the surface, spacings
  double surface_artificial_stress = 0;        // share of it where there is no tensile control
  double normalised = 0;                       // 1: gradients over the sum of kernels, where not corrected
  double eps_v2 = 0, eps_v4 = 0;               // harmonic and biharmonic dissipation of the momentum
  double eps_J2 = 0, eps_J4 = 0;               // the same of the volume ratio
  double adjoint = 0;                          // 1: biharmonic term by the adjoint, 0: as printed
  double projection = 0;                       // 1: on what conserves momenta
  double boundary_projection = 0;              // 1: prescribed where the kernel looks, too
  double cfl = 0, cfl_advection = 0;
  double step = 0;        // s, of every step; 0: by cfl
  double step_speed = 0;  // m/s, which steps of methods that search their neighbours follow
};

/// A constant of a method that a user may set ("--set method.zeta=4") and sweep, and where it goes.
struct MethodConstant {
  std::string_view name;
  double Constants::*member;
  double value;  // published default
  double low, high;
  std::string_view help;
  bool in_spacings = false;  // the member is that many spacings, m
};

}  // namespace taut
