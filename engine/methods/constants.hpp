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

/// The numbers of one run that every method has. SI units. Those of the material are of the only one; where there are
/// several, of the first body's, with the greatest sound speed of all. Each family derives a struct that adds its own.
struct Constants : Elasticity {
  double dp = 0;                 // particle spacing, m
  double h = 0;                  // smoothing length, m
  double contact_stiffness = 1;  // over K1 K2/(K1 + K2), see terms/
  double cfl = 0;
  double step = 0;  // s, of every step; 0: by cfl
};

/// A constant of a method that a user may set ("--set method.zeta=4") and sweep.
struct MethodConstant {
  std::string_view name;
  double value;  // published default
  double low, high;
  std::string_view help;
  bool in_spacings = false;  // the member is that many spacings, m
  bool at_set_up =
      false;  // initial neighbours and their weights depend on it: a running simulation cannot change it
};

/// A constant and the member that it sets of the constants `C` of a family.
template <class C>
struct ConstantRow {
  double C::*member;
  MethodConstant constant;
};

}  // namespace taut
