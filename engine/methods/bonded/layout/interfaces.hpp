#pragma once

#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/constants.hpp"

namespace taut {

inline constexpr double greatest_across = 8;  // maximum of the own G over G_ij of a bond across an interface

/// Particles beside another material, whose deformation has a kink there (THEORY.md, Interfaces). Such a particle has
/// a site unless the normal is not determined (corners, three materials), a side is one layer thin, it is bonded to a
/// clamp, or the materials differ only in density.
struct Interfaces {
  struct Site {
    int id;        // of the particle
    int other;     // index of the material beyond the interface
    double share;  // θ, share of the other material
    Point N, m;    // unit normal; see THEORY.md, Interfaces
  };
  std::vector<Site> sites;
  std::vector<int> begin;      // [sites + 1] first β_ij of each site
  std::vector<int> j;          // id of the particle
  std::vector<double> weight;  // β_ij, 1/m
  double wave_speed = 0;       // m/s; steps that this speed allows are stable for all neighbours of sites
};
Interfaces make_interfaces(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                           const Bonds& bonds, double spacing);

/// A bond of a particle with a site.
struct SiteBond {
  int j;
  Point g, e;                     // g_ij, 1/m; initial direction
  double per_r0_squared;          // 1/m²
  double strength, own_strength;  // G V0_i w_ij, J; the same with G of the own material, ≤ greatest_across G
  bool is_across;
};
std::vector<SiteBond> site_bonds(const Bonds& bonds, const InitialParticles& initial,
                                 const std::vector<Elasticity>& materials, int i);

}  // namespace taut
