#pragma once

#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/constants.hpp"

namespace taut {

inline constexpr double greatest_across = 8;  // G of the own material in bonds across, over G of the bond

/// Particles beside another material, whose deformation has a kink there (THEORY.md, Interfaces). A particle has a site
/// unless the normal is not determined (a corner of an inclusion, three materials), a side is one layer thin, or it is
/// bonded to a clamp. Materials that differ in their density alone have no interface.
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
  double wave_speed = 0;       // m/s: steps that this speed allows are stable for all neighbours of sites
};
Interfaces make_interfaces(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                           const Bonds& bonds, double spacing);

/// A bond of a particle with a site.
struct SiteBond {
  int j;
  Point g, e;                     // g_ij, 1/m; direction at the start
  double per_r0_squared;          // 1/m²
  double strength, own_strength;  // G V0_i w_ij, J; with the G of its own material, limited by the bond's
  bool is_across;
};
std::vector<SiteBond> site_bonds(const Bonds& bonds, const InitialParticles& initial,
                                 const std::vector<Elasticity>& materials, int i);

}  // namespace taut
