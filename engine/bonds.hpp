#pragma once

#include <vector>

#include "engine/layout.hpp"

namespace taut {

/// The pairs of particles of one body within `reach` of each other at t = 0, seen from both sides. They never
/// change: a body that does not break needs no search for neighbours.
struct Bonds {
  std::vector<int> begin;       // [n + 1] first bond of each particle
  std::vector<int> j;           // the other particle
  std::vector<double> r0;       // initial distance, m
  std::vector<double> weight;   // w_ij, as seen from i
  std::vector<Point> gradient;  // g_ij, 1/m: Σ_j (f_j − f_i) g_ij is the gradient of f at i
};

/// Bonds whose moments are right at every particle, on any layout, inside and at a surface:
///   Σ_j w_ij e_a e_b e_c e_d = δ_ab δ_cd + δ_ac δ_bd + δ_ad δ_bc,      Σ_j (X_j − X_i) ⊗ g_ij = I,
/// so that the energy of every linear displacement is exact (see terms/bond.hpp). Of all weights that do so
/// the w_ij are nearest to those of the Laplacian of [Zhang2024] Eq. 19 with the consistent ζ = d + 2, −(d +
/// 2) W′(r0) r0 V_j, and none is negative. A corner has bonds to one side only and comes as near as it can.
Bonds make_bonds(const Layout& layout, double h, double reach);

}  // namespace taut
