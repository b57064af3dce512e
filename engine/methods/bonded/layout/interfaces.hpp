#pragma once

#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/constants.hpp"

namespace taut {

inline constexpr double greatest_across = 8;  // maximum of own G over G_ij

/// Sites: see THEORY.md, Interfaces.
struct Interfaces {
  struct Site {
    int id;
    int other;     // material beyond the interface
    double share;  // θ, share of the other material
    Point N, m;    // unit normal; m of THEORY.md
  };
  std::vector<Site> sites;
  std::vector<int> begin;      // [sites + 1] first β_ij of each site
  std::vector<int> j;          // id
  std::vector<double> weight;  // β_ij, 1/m
  double wave_speed = 0;       // m/s
};
Interfaces make_interfaces(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                           const Bonds& bonds, double spacing);

struct SiteBond {
  int j;
  Point g, e;  // g_ij, 1/m; initial direction
  double per_r0_squared;
  double strength, own_strength;  // G_ij V0_i w_ij in J; G V0_i w_ij, G limited to greatest_across G_ij
  bool is_across;
};
std::vector<SiteBond> site_bonds(const Bonds& bonds, const InitialParticles& initial,
                                 const std::vector<Elasticity>& materials, int i);

}  // namespace taut
