#pragma once

#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/layout/interfaces.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

struct BondConstants {
  int j;          // id of the other end; −1 − p: the bond ends at clamp place p
  double k;       // G (V0_i w_ij + V0_j w_ji)/r0², N/m; equal bits from both ends
  double r2;      // r0², m²
  double energy;  // G V0_i w_ij, J
  Point area;     // a_ij
};

struct CancelledTerm {
  Point X;
  double strength;  // G V0_i w_ij, J
};

struct ClampPlace {
  Point x;             // initial, m
  int rigid_particle;  // id, behind the face
};

/// Arrays by id. `initial` must outlive the setup.
struct BondedSetup {
  const InitialParticles& initial;
  std::vector<Elasticity> materials;
  Bonds bonds;
  std::vector<double> mass;  // [n] kg
  Interfaces interfaces;
  double wave_speed;                     // m/s
  double damping_lead;                   // 3 τ of the bonds, s
  std::vector<ClampPlace> clamp_places;  // sorted by the particle whose bond ends there
  std::vector<int> first_clamp_place;    // [n]

  std::vector<BondConstants> bond_constants(int i) const;
  std::vector<CancelledTerm> cancelled_terms(int i) const;
};

BondedSetup make_bonded_setup(const SolverInput& input, double damping);

/// Marks all rigid particles as clamped, because loads do not act on them.
InitialParticles with_rigid_clamped(const InitialParticles& initial, const Bonds& bonds);

}  // namespace taut
