#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

namespace taut {

inline constexpr std::size_t most_law_parameters = 4;

struct Elasticity {
  double rho0 = 0;                                   // kg/m³
  double c0 = 0;                                     // √(K/ρ0), m/s, [Zhang2024] Eq. 5
  double K = 0, G = 0;                               // Pa
  std::array<double, most_law_parameters> of_law{};  // values of LawRow::parameters
};

/// In m/s, in plane strain and 3D.
inline double compression_wave_speed(const Elasticity& m) {
  return std::sqrt((m.K + 4.0 / 3 * m.G) / m.rho0);
}

/// The inherited elasticity is the first particle's, with the maximum c0 of all materials.
struct Constants : Elasticity {
  double dp = 0;                 // m
  double h = 0;                  // m
  double contact_stiffness = 1;  // factor of the contact law's stiffness
  double cfl = 0;
  double step = 0;  // fixed, s; 0: from cfl
};

/// Constant that users may set, as in "--set method.zeta=4".
struct MethodConstant {
  std::string_view name;
  double value;
  double low, high;
  std::string_view help;
  bool in_spacings = false;
  bool at_set_up = false;                          // fixed during a run
  std::span<const std::string_view> choices = {};  // names of 0, 1, …, the default first; empty: a number
  bool is_switch = false;                          // only 0 or 1
};

inline MethodConstant switch_constant(std::string_view name, double value, std::string_view help) {
  return {.name = name, .value = value, .low = 0, .high = 1, .help = help, .is_switch = true};
}

template <class C>
struct ConstantRow {
  double C::*member;
  MethodConstant constant;
};

}  // namespace taut
