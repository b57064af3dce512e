#pragma once

#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/constants.hpp"

namespace taut {

inline constexpr double greatest_across = 8;  // maximum own G over G_ij

/// Particles with a kink (THEORY.md, Interfaces), unless normals are unclear, a side is one layer thin, a clamp is
/// near, or only densities differ.
struct Interfaces {
  struct Site {
    int id;
    int other;
    double share;  // θ
    Point N, m;
  };
  std::vector<Site> sites;
  std::vector<int> begin;  // [sites + 1] first β_ij
  std::vector<int> j;
  std::vector<double> weight;  // β_ij, 1/m
  double wave_speed = 0;       // limits the time step, m/s
};
Interfaces make_interfaces(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                           const Bonds& bonds, double spacing);

struct SiteBond {
  int j;
  Point g, e;                     // g_ij, 1/m; initial direction
  double per_r0_squared;          // 1/m²
  double strength, own_strength;  // G V0_i w_ij, J; with the own G, limited
  bool is_across;
};
std::vector<SiteBond> site_bonds(const Bonds& bonds, const InitialParticles& initial,
                                 const std::vector<Elasticity>& materials, int i);

}  // namespace taut
