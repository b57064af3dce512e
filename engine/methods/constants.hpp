#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace taut {

inline constexpr std::size_t most_law_parameters = 4;

/// Elastic constants of a material.
struct Elasticity {
  double rho0 = 0;                                   // kg/m³
  double c0 = 0;                                     // sound speed √(K/ρ0), m/s, [Zhang2024] Eq. 5
  double K = 0, G = 0;                               // bulk and shear modulus, Pa
  std::array<double, most_law_parameters> of_law{};  // values of LawRow::parameters, in this order
};

/// Speed of compression waves in plane strain and 3D, m/s.
inline double compression_wave_speed(const Elasticity& m) {
  return std::sqrt((m.K + 4.0 / 3 * m.G) / m.rho0);
}

/// Constants of a run that all methods share, in SI units. With several materials, the elastic constants are the
/// first body's, and c0 is the maximum of all. Families derive structs that add their own constants.
struct Constants : Elasticity {
  double dp = 0;                 // particle spacing, m
  double h = 0;                  // smoothing length, m
  double contact_stiffness = 1;  // relative to K1 K2/(K1 + K2), see terms/
  double cfl = 0;
  double step = 0;  // fixed time step, s; 0: from cfl
};

/// A constant that a user may set ("--set method.zeta=4") and sweep.
struct MethodConstant {
  std::string_view name;
  double value;  // published default
  double low, high;
  std::string_view help;
  bool in_spacings = false;  // `value` is in spacings, the member in m
  bool at_set_up = false;    // set-up depends on it: a running simulation cannot change it
};

/// A constant and the member of the family's constants `C` that it sets.
template <class C>
struct ConstantRow {
  double C::*member;
  MethodConstant constant;
};

}  // namespace taut
