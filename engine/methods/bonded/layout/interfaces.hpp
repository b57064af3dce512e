#pragma once

#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/constants.hpp"

namespace taut {

inline constexpr double greatest_across = 8;  // limit of own G over G_ij

/// Particles beside another material, where the deformation has a kink (THEORY.md, Interfaces). Excluded are unclear
/// normals, sides one layer thin, neighbours of clamps, and materials that differ only in density.
struct Interfaces {
  struct Site {
    int id;        // of the particle
    int other;     // other material
    double share;  // θ
    Point N, m;
  };
  std::vector<Site> sites;
  std::vector<int> begin;      // [sites + 1] first β_ij
  std::vector<int> j;          // particle
  std::vector<double> weight;  // β_ij, 1/m
  double wave_speed = 0;       // m/s; for the time step
};
Interfaces make_interfaces(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                           const Bonds& bonds, double spacing);

/// A bond of a particle with a site.
struct SiteBond {
  int j;
  Point g, e;                     // g_ij, 1/m; initial direction
  double per_r0_squared;          // 1/m²
  double strength, own_strength;  // G V0_i w_ij, J; with the own G, limited by greatest_across
  bool is_across;
};
std::vector<SiteBond> site_bonds(const Bonds& bonds, const InitialParticles& initial,
                                 const std::vector<Elasticity>& materials, int i);

}  // namespace taut
