#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/methods/elastic_law.hpp"
#include "engine/methods/kernel_name.hpp"
#include "engine/methods/term_info.hpp"
#include "engine/scene/contact_law.hpp"

namespace taut {

/// The algorithm that runs a method, a folder of engine/families/.
enum class Family : std::uint8_t {
  ul_split,         // updated Lagrangian, pressure and shear stress act apart; [Zhang2024] §5
  ul_cauchy,        // updated Lagrangian, the divergence of σ = −pI + s as a whole; [Khayyer2024] Eq. 9
  bonded,           // an energy of bonds between initial neighbours; ours, terms/bond.hpp
  tl_displacement,  // first Piola–Kirchhoff stress on initial pairs, F from the positions; [Lee2016] Eq. 29c
  tl_mixed,         // the same with F as an unknown of its own; [Lee2016] §3.3.2
};

/// How the shear stress of ul_split acts on the velocity.
enum class Shear : std::uint8_t {
  none,                // of the other families
  nested_stress,       // ∇·s, s from the Jaumann rate of the velocity gradient; [Zhang2024] Eq. 7, 13, 14
  laplacian_velocity,  // ∫ G/ρ ∇²v dt with the angular-momentum-conserving operator; [Zhang2024] Eq. 19, 20
  laplacian_velocity_nonconservative,  // the same with the plain operator; [Zhang2024] Eq. 18
};

/// The trace that is taken from the strain rate: two different materials in plane strain.
enum class Deviator : std::uint8_t {
  in_plane,      // 1/d of the trace, [Zhang2024] Eq. 7: in-plane bulk modulus K, s_zz = 0
  plane_strain,  // 1/3 of the trace, [Khayyer2024] Eq. 6: in-plane bulk modulus K + G/3
};

/// What each pair contributes to (1/ρ) ∇·σ.
enum class PairStress : std::uint8_t {
  product,  // m_j (σ_i + σ_j)/(ρ_i ρ_j), [Khayyer2024] Eq. 9
  squares,  // m_j (σ_i/ρ_i² + σ_j/ρ_j²), [TranDuc2023] Eq. 2.3
};

/// Where the rate of density comes from.
enum class Continuity : std::uint8_t {
  velocity_gradient,  // −ρ tr ∇û, [Khayyer2024] Eq. 8, 29
  masses,             // Σ m_j u_ij·∇W, [TranDuc2023] §2.2
};

/// What damps the velocities of pairs.
enum class Viscosity : std::uint8_t {
  none,
  artificial,  // [Khayyer2024] Eq. 15, 16
  riemann,     // from a Riemann problem of second order, [Khayyer2024] Eq. 39–45
};

/// What a method on the initial configuration integrates in time, with the positions.
enum class Unknowns : std::uint8_t {
  velocity,  // the deformation gradient comes from the positions
  v_F,       // it is an unknown of its own: {p, F}, [Lee2016] §3.3.2
  v_F_J,     // and so is the volume ratio: {p, F, J}
  v_F_H_J,   // and the cofactor of the deformation gradient: {p, F, H, J}
};

/// How gradients on initial pairs are made right; solver/initial_pairs.hpp.
enum class GradientCorrection : std::uint8_t { corrected, normalised };

/// What a method is. Named values of it, and nothing else, are instantiated.
struct Formulation {
  std::string_view name;
  std::string_view paper;
  std::string_view summary;
  std::string_view conserves;
  Family family = Family::ul_split;
  Shear shear = Shear::none;                 // of ul_split
  std::span<const Citation> citations = {};  // of the paper, where its family cites another one
  bool artificial_stress = false;            // Gray's
  double epsilon = 0, exponent = 0;          // of the same
  PairStress pair_stress = PairStress::product;
  Continuity continuity = Continuity::velocity_gradient;
  Viscosity viscosity = Viscosity::none;   // of methods with a Cauchy stress
  bool corrected = false;                  // kernel gradients, [Khayyer2024] Eq. 27–31
  bool transport_velocity = false;         // XSPH, [Khayyer2024] Eq. 14
  bool density_diffusion = false;          // [Khayyer2024] Eq. 32–35
  bool tensile_control = false;            // TIC inside, artificial stress at surfaces, [Khayyer2024] §3.4
  Law law = Law::none;                     // of methods on the initial configuration
  bool free_law = false;                   // which may be another one, see LawRow::choice
  Unknowns unknowns = Unknowns::velocity;  // of the same
  bool jst = false;                        // dissipation of [Lee2016] §3.4
  GradientCorrection gradient = GradientCorrection::corrected;  // of the same
  Deviator deviator = Deviator::in_plane;
  KernelName kernel = KernelName::wendland_c2;
  ContactLaw contact = ContactLaw::sph;  // the published one
  double contact_stiffness = 1;          // of the penalty, see terms/penalty_contact.hpp
  bool several_materials = false;        // in one scene
  double beta_least = 1;       // of the dissipation in P*: 1 = linear, 0 = limited; see terms/riemann.hpp
  double h_over_dp = 1.3;      // smoothing length over spacing
  double h_over_dp_3d = 0;     // 0: as in the plane
  double cfl = 0.4;            // acoustic, [Zhang2024] Eq. 22
  double cfl_advection = 0.2;  // [Zhang2024] Eq. 21
};

/// The stress a method keeps for each particle is one it computes with (true), or one that is only
/// recovered to be shown (false).
constexpr bool carries_stress(const Formulation& m) {
  return m.shear == Shear::nested_stress || m.family == Family::ul_cauchy;
}

/// Held particles of a method with stress are strained by the others, so that the stress is continuous across
/// the clamp: with an unstrained clamp `oas` tears off it. Those of the other methods are rigid, their
/// density stays: strained, `enog` would be stiffer at the clamp and not converge to the period of the plate.
/// [Zhang2024] does not say.
constexpr bool strains_what_is_held(const Formulation& m) { return carries_stress(m); }

/// Its volume ratio J has an equation of its own.
constexpr bool follows_volume_ratio(const Formulation& m) {
  return m.unknowns == Unknowns::v_F_J || m.unknowns == Unknowns::v_F_H_J;
}

/// The neighbours of a particle inside its body are those of the start.
constexpr bool keeps_neighbors(const Formulation& m) {
  return m.family == Family::bonded || m.family == Family::tl_displacement || m.family == Family::tl_mixed;
}

/// Of the scenes that it can run.
constexpr int greatest_dim(const Formulation& m) { return m.family == Family::ul_cauchy ? 2 : 3; }

/// What only the methods of one family have belongs to it.
constexpr bool of_its_family(const Formulation& m) {
  const bool split = m.family == Family::ul_split, cauchy = m.family == Family::ul_cauchy;
  const bool mixed = m.family == Family::tl_mixed, has_law = keeps_neighbors(m);
  const bool cauchy_switches = m.pair_stress != PairStress::product ||
                               m.continuity != Continuity::velocity_gradient ||
                               m.viscosity != Viscosity::none || m.corrected || m.transport_velocity ||
                               m.density_diffusion || m.tensile_control;
  return split == (m.shear != Shear::none) && (cauchy || !cauchy_switches) &&
         has_law == (m.law != Law::none) &&  // others have a stress rate
         mixed == (m.unknowns != Unknowns::velocity) && (mixed || !m.jst) && (has_law || !m.free_law);
}

/// Mixtures that make no sense are refused at compile time.
constexpr bool consistent(const Formulation& m) {
  // ∇ρ and ∇u of the second-order terms are corrected ones, and so is what TIC switches to
  const bool second_order = m.density_diffusion || m.viscosity == Viscosity::riemann || m.tensile_control;
  return of_its_family(m) && (!m.artificial_stress || carries_stress(m)) &&  // what it would be taken from
         m.artificial_stress == (m.epsilon > 0) && (m.corrected || !second_order) &&
         (!m.tensile_control || m.artificial_stress) &&             // which the surface keeps
         (m.pair_stress == PairStress::product || !m.corrected) &&  // no paper has both
         (!follows_volume_ratio(m) || takes_volume_ratio(m.law)) && m.h_over_dp > 0 && m.h_over_dp_3d >= 0 &&
         m.cfl > 0 && m.cfl_advection > 0 && !m.name.empty();
}

}  // namespace taut
