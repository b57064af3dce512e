#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace references {

/// Elements computed together, in one vector register.
constexpr int lanes = 4;
using Lanes = double __attribute__((vector_size(lanes * sizeof(double))));

template <int d>
using Vector = std::array<double, d>;

enum class Law {
  neo_hookean,  ///< W = G/2 (J^(-2/3) tr C - 3) + K/2 (J - 1)²; plane strain in 2D
  deviator_2d,  ///< W = G/2 (tr C2D / J - 2) + K/2 (J - 1)², C2D the 2 x 2 part of C
};

struct Material {
  Law law = Law::neo_hookean;
  double density = 0;          ///< kg/m³
  double bulk = 0, shear = 0;  ///< K and G, Pa

  static Material of(Law law, double density, double youngs_modulus, double poisson_ratio) {
    return {law, density, youngs_modulus / (3 * (1 - 2 * poisson_ratio)),
            youngs_modulus / (2 * (1 + poisson_ratio))};
  }
  /// Speed of pressure waves in the unstrained 3D material, m/s; an upper bound for both laws in 2D.
  double wave_speed() const { return std::sqrt((bulk + 4 * shear / 3) / density); }
  /// Reference speed of sound of the papers, m/s.
  double c0() const { return std::sqrt(bulk / density); }

  /// Power m of J in the isochoric term J^(-m) tr C.
  double power() const { return law == Law::neo_hookean ? 2. / 3 : 1; }
  /// Out-of-plane part of tr C.
  template <int d>
  double across() const {
    return d == 2 && law == Law::neo_hookean ? 1 : 0;
  }
  /// J^(-m), or NaN for a folded element, which ends the run.
  template <class T>
  T isochoric(const T& jacobian) const {
    if constexpr (std::is_same_v<T, double>) {
      if (!(jacobian > 0)) return std::numeric_limits<double>::quiet_NaN();
      return law == Law::neo_hookean ? 1 / std::cbrt(jacobian * jacobian) : 1 / jacobian;
    } else {
      T result;
      for (int lane = 0; lane < lanes; ++lane) result[lane] = isochoric(double{jacobian[lane]});
      return result;
    }
  }
};

/// Deformation gradient F and its cofactors; T is a number or `Lanes`.
template <int d, class T>
struct Strain {
  std::array<std::array<T, d>, d> f, cofactor;
  T jacobian, trace;  ///< J and tr C

  explicit Strain(const std::array<std::array<T, d>, d>& gradient, double across) : f(gradient) {
    if constexpr (d == 2) {
      cofactor = {{{f[1][1], -f[1][0]}, {-f[0][1], f[0][0]}}};
    } else {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int a = (i + 1) % 3, b = (i + 2) % 3, k = (j + 1) % 3, l = (j + 2) % 3;
          cofactor[i][j] = f[a][k] * f[b][l] - f[a][l] * f[b][k];
        }
    }
    jacobian = f[0][0] * cofactor[0][0];
    for (int j = 1; j < d; ++j) jacobian += f[0][j] * cofactor[0][j];
    trace = f[0][0] * f[0][0] + across;
    for (int k = 1; k < d * d; ++k) trace += f[k / d][k % d] * f[k / d][k % d];
  }
};

/// Replaces the deformation gradient by the first Piola-Kirchhoff stress ∂W/∂F, Pa; returns W, J/m³.
template <int d, class T>
T stress(const Material& material, std::array<std::array<T, d>, d>& gradient) {
  const Strain<d, T> strain(gradient, material.template across<d>());
  const T& jacobian = strain.jacobian;
  const T factor = material.shear * material.isochoric(jacobian), distortion = factor * strain.trace;
  const T volume = material.bulk * (jacobian - 1) - material.power() / 2 * distortion / jacobian;
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) gradient[i][j] = factor * strain.f[i][j] + volume * strain.cofactor[i][j];
  return 0.5 * (distortion - 2 / material.power() * material.shear +
                material.bulk * (jacobian - 1) * (jacobian - 1));
}

}  // namespace references
