#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "engine/methods/kernel_name.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// How the shear stress acts on the velocity.
enum class Shear : std::uint8_t {
  nested_stress,       // ∇·s, s from the Jaumann rate of the velocity gradient; [Zhang2024] Eq. 7, 13, 14
  laplacian_velocity,  // ∫ G/ρ ∇²v dt with the angular-momentum-conserving operator; [Zhang2024] Eq. 19, 20
  bonds,  // the force of ∫ G/ρ ∇²v dt kept for each pair and turned with it: an energy; ours, terms/bond.hpp
  laplacian_velocity_nonconservative,  // the same with the plain operator; [Zhang2024] Eq. 18
  cauchy_stress,     // as part of σ = −pI + s, whose divergence is taken; [Khayyer2024] Eq. 9
  reference_stress,  // as part of the first Piola–Kirchhoff stress on neighbours of the start; [Lee2016]
                     // Eq. 29c
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

/// What damps the velocities of pairs.
enum class Viscosity : std::uint8_t {
  none,
  artificial,  // [Khayyer2024] Eq. 15, 16
  riemann,     // from a Riemann problem of second order, [Khayyer2024] Eq. 39–45
};
/// What gives the stress for the deformation gradient; engine/materials/.
enum class Law : std::uint8_t { none, neo_hookean, st_venant_kirchhoff, linear_elastic, rotated_piola };

/// What a method on the configuration of the start integrates in time, with the positions.
enum class Unknowns : std::uint8_t {
  velocity,  // the deformation gradient comes from the positions
  v_F,       // it is an unknown of its own: {p, F}, [Lee2016] §3.3.2
  v_F_J,     // and so is the volume ratio: {p, F, J}
};

/// How gradients on neighbours of the start are made right; solver/initial_pairs.hpp.
enum class GradientCorrection : std::uint8_t { corrected, normalised };

/// What a method is. Named values of it, and nothing else, are instantiated.
struct Formulation {
  std::string_view name;
  std::string_view paper;
  std::string_view summary;
  std::string_view conserves;
  Shear shear;
  bool artificial_stress = false;  // Gray's
  PairStress pair_stress = PairStress::product;
  Viscosity viscosity = Viscosity::none;   // of methods with a Cauchy stress
  bool corrected = false;                  // kernel gradients, [Khayyer2024] Eq. 27–31
  bool transport_velocity = false;         // XSPH, [Khayyer2024] Eq. 14
  bool density_diffusion = false;          // [Khayyer2024] Eq. 32–35
  bool tensile_control = false;            // TIC inside, artificial stress at surfaces, [Khayyer2024] §3.4
  Law law = Law::none;                     // of methods on the configuration of the start
  bool free_law = false;                   // which may be another one, see free_laws
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
  double cfl = 0.4;            // acoustic, [Zhang2024] Eq. 22
  double cfl_advection = 0.2;  // [Zhang2024] Eq. 21
};

/// The stress a method keeps for each particle is one it computes with (true), or one that is only
/// recovered to be shown (false).
constexpr bool carries_stress(const Formulation& m) {
  return m.shear == Shear::nested_stress || m.shear == Shear::cauchy_stress;
}

/// What only the solver of methods with a Cauchy stress has.
constexpr bool has_cauchy_switches(const Formulation& m) {
  return m.pair_stress != PairStress::product || m.viscosity != Viscosity::none || m.corrected ||
         m.transport_velocity || m.density_diffusion || m.tensile_control;
}

/// Held particles of a method with stress are strained by the others, so that the stress is continuous across
/// the clamp: with an unstrained clamp `oas` tears off it. Those of the other methods are rigid, their
/// density stays: strained, `enog` would be stiffer at the clamp and not converge to the period of the plate.
/// [Zhang2024] does not say.
constexpr bool strains_what_is_held(const Formulation& m) { return carries_stress(m); }

/// The deformation gradient is an unknown of its own.
constexpr bool is_mixed(const Formulation& m) { return m.unknowns != Unknowns::velocity; }

/// What a method with a free law can run with; the first one is that of its paper.
inline constexpr std::array free_laws{Law::neo_hookean, Law::st_venant_kirchhoff, Law::linear_elastic};

/// The method M with another law. Not one of the named methods, but a setting of theirs.
template <const Formulation& M, Law law>
inline constexpr Formulation with_law = [] {
  Formulation changed = M;
  changed.law = law;
  return changed;
}();

/// Mixtures that make no sense are refused at compile time.
constexpr bool consistent(const Formulation& m) {
  return (!m.artificial_stress || carries_stress(m))  // there is no stress to take it from
         && (m.shear == Shear::cauchy_stress || !has_cauchy_switches(m))
         // ∇ρ and ∇u of the second-order terms are corrected ones, and so is what TIC switches to
         &&
         (m.corrected || (!m.density_diffusion && m.viscosity != Viscosity::riemann && !m.tensile_control)) &&
         (!m.tensile_control || m.artificial_stress)                      // which the surface keeps
         && (m.pair_stress == PairStress::product || !m.corrected)        // no paper has both
         && (m.shear == Shear::reference_stress) == (m.law != Law::none)  // others have a stress rate
         && (!m.free_law || m.law == free_laws.front()) &&
         (m.shear == Shear::reference_stress || !is_mixed(m)) && (!m.jst || is_mixed(m)) &&
         (m.unknowns != Unknowns::v_F_J || m.law == Law::neo_hookean)  // the other laws take J from F
         && m.h_over_dp > 0 && m.cfl > 0 && m.cfl_advection > 0 && !m.name.empty();
}

inline constexpr Formulation og{
    .name = "og",
    .paper = "Zhang2024 §3",
    .summary = "nested shear stress, low-dissipation Riemann terms, no cure for tension: fractures",
    .conserves = "linear momentum",
    .shear = Shear::nested_stress,
    .beta_least = 0,
};
inline constexpr Formulation oas{
    .name = "oas",
    .paper = "Zhang2024 §6",
    .summary = "og with Gray's artificial stress: no fracture at first, zigzag modes stay",
    .conserves = "linear momentum",
    .shear = Shear::nested_stress,
    .artificial_stress = true,
};
inline constexpr Formulation enog{
    .name = "enog",
    .paper = "Zhang2024 §4",
    .summary =
        "shear acceleration from a non-nested Laplacian of the velocity: no zigzag, no tension instability",
    .conserves = "linear momentum",
    .shear = Shear::laplacian_velocity,
};
inline constexpr Formulation enog_nonconservative{
    .name = "enog-nonconservative",
    .paper = "Zhang2024 Eq. 18, Fig. 7",
    .summary = "enog with the plain Laplacian: resists rotation, as published",
    .conserves = "linear momentum",
    .shear = Shear::laplacian_velocity_nonconservative,
};

inline constexpr Formulation oenog{
    .name = "oenog",
    .paper = "none: ours",
    .summary =
        "objective ENOG: its pair forces turn with the pairs of the start; an energy, and no search in a "
        "body",
    .conserves = "linear momentum, angular momentum",
    .shear = Shear::bonds,
    .deviator = Deviator::plane_strain,
    .contact = ContactLaw::penalty,
    .contact_stiffness = 2,  // a layer of the material
    .several_materials = true,
    .h_over_dp = 0.8,  // the eight nearest on a square lattice, see engine/families/bonded/bonds.hpp
    .cfl = 0.64,       // over dp/(c_p + |v|max), c_p of compression; the lattice is stable up to 0.97
};

}  // namespace taut
