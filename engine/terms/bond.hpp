#pragma once

#include <cmath>

#include "engine/core/cube_root.hpp"
#include "engine/core/pack.hpp"
#include "engine/core/tensor.hpp"
#include "engine/methods/term_info.hpp"

/// `oenog`, an objective relative of ENOG that no paper has. In 2D; in 3D the sums over 1/s are others.
///
/// [Zhang2024] Eq. 20 adds up a shear force along e_ij for each pair, but in axes fixed in space: a stressed
/// body that turns keeps the force of its old attitude. Adding it up for each pair and letting it act along
/// the present e_ij cures that. Since e_ij·v_ij = dr/dt, the sum over time is then a function of r alone,
///   ∫ 2ζG (e·v_ij)/r W′(r0) V_i V_j dt = 2ζG W′(r0) V_i V_j ln(r/r0),
/// so the history is that of a spring, and the whole method can be written as an energy of the positions,
///   E = Σ_i V_i [ G Σ_j w_ij φ(r_ij/r0_ij) + U_i(F_i) ],   F_i = Σ_j (x_j − x_i) ⊗ g_ij,
/// whose derivatives are the forces
///   f_i = Σ_j k_ij φ′(λ_ij)/λ_ij (x_j − x_i) + Σ_j (V_i P_i g_ij − V_j P_j g_ji),
///   k_ij = G (V_i w_ij + V_j w_ji)/r0_ij²,   P = ∂U/∂F.
/// What follows from there being an energy that no translation or rotation changes: linear and angular
/// momentum are kept to round-off, a turned body keeps its stress, and the energy is kept as well as the time
/// integrator can. The bonds resist every displacement of a particle against its neighbours: there is no
/// zigzag mode.
///
/// Law. U_i is what the bonds of particle i leave to the neo-Hookean energy of plane strain,
///   W = G/2 (J^(−2/3) tr C − 3) + K/2 (J − 1)²,
/// so that a linear displacement has just the energy W (of one material, and where the moments are right).
/// With t = ½ tr C, D = ¼ (C_xx − C_yy) + ½ i C_xy and the bond's direction θ, s = λ² = t + 2 Re(D e^(−2iθ)).
/// Since Σ_j w e⊗e⊗e⊗e is isotropic (engine/families/bonded/bonds.hpp),
///   Σ w = 8,   Σ w s = 8 t,   Σ w s² = 4 (3 t² − J²).
/// The mean of 1/s over all directions is 1/J, and its Fourier series is known,
///   1/s = 1/J [1 + 2 Σ_n Re((−ζ)^n e^(−2inθ))],   ζ = 2D/(t + J),   |ζ| < 1,
/// so that of the directions that a particle has
///   Σ w/s = 8/J − 2/J R,   R = Re(ζ³ Z₆ − ζ⁴ Z₈) + …,   Z_n = Σ_j w_ij e^(−inθ_ij).
/// On a square lattice with its eight bonds of equal weight the next term is ζ⁸ Z₁₆: exact for all but the
/// largest strains. With φ = (2s² − 3s + 1/s)/24 the bonds carry G (t² − t − J²/3 + (1 − R/4)/(3J)), and
///   U = W − G (t² − t − J²/3 + (1 − R/4)/(3J)).
/// Below J = ½ the terms in G are taken at c = ¼ + 1/(12 − 16 J), which goes on from J with its slope and
/// stays above ¼, and U has (K + 4G/3)(1 − 2J)³ more, which W lacks: particles that are pressed together in a
/// crease do not fall into the 1/J that their bonds, being few, do not make up for, and what is turned inside
/// out comes back.
///
/// Which φ. Any with φ′(1) = 0 and φ″(1) = 1 gives the same law for linear displacements, but not for
/// zigzags: these see the bonds alone. Of φ = ((1 − a) s² + (3a − 2) s + a/s)/8 + const, a = 0 lets zigzags
/// go once a square lattice is pressed to λ = 0.81 on all sides, a = 1 once it is pulled to 1.3; a = 1/3
/// holds from 0.7 on all sides, or 0.64 on two with the others held, up to a pull of 2.0 (least eigenvalue
/// over all wave vectors). The φ of earlier versions, 7/72 s + 3/(72 s) + 2/(72 s²), right to third order
/// with U(J) alone, let go at 1.3: a plate that a fast ball stretched took on a hexagonal pattern.
///
/// Damping. A blow leaves vibrations at the scale of the spacing, for which the continuum has no counterpart
/// and which nothing takes away. Each bond has a dashpot in parallel, φ′/λ + τ dq/dt with q = (λ² − 1)/2 and
/// τ = damping · dp/√(G/ρ0), of the fastest material: along x_j − x_i, so that both momenta stay. At 0.01 a
/// zigzag falls to 1/e in about ten of its periods, the first bending mode of a plate of ten particles by 0.2
/// to 0.4 % in thirty; the loss falls with dp. Zero keeps the energy.
namespace taut::inline TAUT_ISA {

/// φ = (2 s² − 3 s + 1/s)/24, of s = λ² = r²/r0²
template <class T>
T bond_energy(const T& s) {
  return (s * (2 * s - 3) + 1 / s) / 24;
}
inline constexpr TermInfo bond_energy_info{
    "energy", "E = Σ_i V_i [ G Σ_j w_ij φ(r_ij/r0_ij) + U_i(F_i) ]", "ours", "terms/bond.hpp:bond_energy",
    "bond: a linear displacement has the neo-Hookean energy and stress"};

/// φ′(λ)/λ of s = λ²: times k (x_j − x_i) with k = G (V_i w_ij + V_j w_ji)/r0² it is the force on i.
template <class T>
T bond_slope(const T& s) {
  const T inverse = 1 / s;
  return (4 * s - 3 - inverse * inverse) / 12;
}
inline constexpr TermInfo bond_force_info{
    "bond force", "f_i = Σ_j k_ij φ′(λ_ij)/λ_ij (x_j − x_i), φ = (2λ⁴ − 3λ² + λ⁻²)/24",
    "ours, from [Zhang2024] Eq. 20", "terms/bond.hpp:bond_slope",
    "bond: the slopes are those of the energies, and rise"};

/// φ″(λ) of s = λ²: 1 at rest. What a bond resists its own stretch with.
template <class T>
T bond_stiffness(const T& s) {
  const T inverse = 1 / s;
  return s - 0.25 + 0.25 * inverse * inverse;
}

/// What the part (K + 4G/3)(1 − 2J)³ of U adds to the stiffness of a particle, over that of one at rest
template <class T>
T closing_stiffness(const T& J) {
  return 1 + 24 * max(1 - 2 * J, T{});
}

/// Not std::complex, which looks for infinities in every product.
template <class T>
struct Complex {
  T re, im;
  friend Complex operator*(const Complex& a, const Complex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Complex operator*(const T& s, const Complex& a) { return {s * a.re, s * a.im}; }
  friend Complex operator-(const Complex& a, const Complex& b) { return {a.re - b.re, a.im - b.im}; }
};

/// What the bonds of a particle leave to the neo-Hookean energy, a function of F; see above. T: of one
/// particle or of four.
template <class T>
struct Remainder {
  T K, G;             // Pa
  Complex<T> Z6, Z8;  // Σ_j w_ij e^(−inθ), θ the direction of X_ij

  T energy(const Mat<T, 2>& F) const {  // Pa
    const auto [t, J, c, per_J, N] = invariants(F);
    const T root = inverse_cube_root(c), R = excess((1 / (t + c)) * N);
    return 0.5 * G * (root * root * (2 * t + 1) - 3) + 0.5 * K * (J - 1) * (J - 1) -
           G * (t * (t - 1) - (c * c - (1 - 0.25 * R) / c) / 3) + wave_modulus() * power<3>(shut(J));
  }
  Mat<T, 2> piola(const Mat<T, 2>& F) const {  // ∂energy/∂F, Pa
    const auto [t, J, c, per_J, N] = invariants(F);
    const T root = inverse_cube_root(c), shear = root * root, over = 1 / c, narrow = 1 / (t + c);
    const Complex<T> z = narrow * N, slope = z * z * (filled<T>(3) * Z6 - filled<T>(4) * z * Z8);  // ∂R/∂ζ
    const T turn = G / 12 * over * narrow, both = turn * (slope * z).re;
    const T of_t = G * (shear - 2 * t + 1) - both;
    const T of_c = -G / 3 * (over * (shear * (2 * t + 1) - over * (1 - 0.25 * excess(z))) - 2 * c) - both;
    const T of_J = K * (J - 1) - 6 * wave_modulus() * power<2>(shut(J)) + of_c * per_J;
    const Sym<T, 2> S{of_t + turn * slope.re, -turn * slope.im, of_t - turn * slope.re};
    return product(F, S) + of_J * cofactor(F);
  }

 private:
  struct Invariants {
    T t, J;        // ½ tr C, det F
    T c, per_J;    // what stands for J, dc/dJ
    Complex<T> N;  // ½ (C_xx − C_yy) + i C_xy: ζ = N/(t + c)
  };
  static Invariants invariants(const Mat<T, 2>& F) {
    const T xx = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0), yy = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1);
    const T xy = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1), J = determinant(F);
    const T below = 0.25 / (0.75 - min(J, filled<T>(0.5))), one = filled<T>(1);
    return {0.5 * (xx + yy),
            J,
            J < 0.5 ? 0.25 + 0.25 * below : J,
            J < 0.5 ? below * below : one,
            {0.5 * (xx - yy), xy}};
  }
  T excess(const Complex<T>& z) const { return (z * z * z * (Z6 - z * Z8)).re; }  // R
  static T shut(const T& J) { return max(1 - 2 * J, T{}); }
  T wave_modulus() const { return K + 4.0 / 3 * G; }
};
inline constexpr TermInfo remainder_info{
    "stress",
    "f_i = Σ_j (V_i P_i g_ij − V_j P_j g_ji), P = ∂U/∂F, U = W − G (t² − t − J²/3 + (1 − R/4)/(3J))", "ours",
    "terms/bond.hpp:Remainder", "bond: the slopes are those of the energies, and rise"};

}  // namespace taut::inline TAUT_ISA
