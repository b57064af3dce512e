#pragma once

#include <vector>

#include "engine/families/bonded/bonds.hpp"
#include "engine/methods/constants.hpp"

namespace taut {

inline constexpr double most_of_across = 8;  // see below

/// Where two materials of a body meet. There the deformation has a kink, F_own − F_other = b ⊗ N with N from
/// the own material to the other one, and F_i, a mean over both sides, is the deformation of neither: were it
/// the own one's, a stiff particle would feel the stretch of its soft neighbours, and the first layer of the
/// stiff side would show a multiple of the stress, or its opposite. So the energy of such a particle is that
/// of the layers it stands for,
///   E_i = V_i [(1 − θ) W_own(F_own) + θ W_other(F_other)] − V0_i Σ_within G w_ij φ_c(s_own) + Σ_across E_ij,
///   F_own = F_i + b ⊗ m,   F_other = F_own − b ⊗ N,   m = ½ Σ_across (N·X_ij) g_ij,   θ = N·m,
///   E_ij = V0_i w_ij [(G ψ(s_own) − G_ij ψ(s_mid))(s_ij − s_mid)/2 − G_ij φ_c(s_mid)
///                     + max(G − G_ij, 0) (s_ij − s_mid)²/8],   ψ = φ′/λ = 2 dφ/ds,
/// beside the springs. s_own and s_mid are those of F_own and of F_own − ½ b ⊗ N, since one half of a bond
/// across lies in either material; its spring has the strength of both in series, and E_ij adds what it lacks
/// for the force that the bonds of the own material would have, of which G counts up to most_of_across G_ij:
/// a bond across is as weak as the weaker side, and what it lacks must not outweigh it. Its last part, 0 where each
/// side is linear, holds a bond to the deformation of the layers as stiffly as G would: without it a neighbour that
/// gives way frees more of G ψ(s_own) than its spring takes, and bodies flew apart from rest (a stiff ball in a soft
/// box at a ratio of 15, half discs at 4). The kink is that of
/// the gradients of the two sides, each from its own particles,
///   b = Σ_j β_ij (x_j − x_i) = (∇_own x − ∇_other x) N,
/// the other side's at the neighbours across. It is 0 for a linear displacement. A displacement that is
/// linear on either side of a plane half-way between two layers, with a traction that is the same on both,
/// leaves no force: in series and in parallel, under shear, at any ratio of the moduli.
///
/// A particle has a site unless N cannot be told (a corner of an inclusion, three materials), a side is one
/// layer thin, or it is bonded to a clamp. It then has the energy of any other particle. Materials that
/// differ in their density alone have no interface.
struct Interfaces {
  struct Site {
    int id;        // of the particle
    int other;     // material beyond
    double share;  // θ, of the other material
    Point N, m;
  };
  std::vector<Site> sites;
  std::vector<int> begin;      // [sites + 1] first of the β_ij of each
  std::vector<int> j;          // particle
  std::vector<double> weight;  // β_ij, 1/m
  /// m/s: with the steps that a wave of this speed allows, what a site gives its neighbours is stable too,
  /// however light they are.
  double wave_speed = 0;
};
Interfaces make_interfaces(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                           const Bonds& bonds, double spacing);

/// A bond from one material into another one that is as stiff is not across.
bool is_across(const InitialParticles& initial, const std::vector<Elasticity>& materials, int i, int j);

}  // namespace taut
