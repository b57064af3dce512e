#pragma once

#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/layout/interfaces.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// A bond with its constants for one end.
struct BondConstants {
  int j;          // id of the other end; −1 − p: clamp place p
  double k;       // G (V0_i w_ij + V0_j w_ji)/r0², N/m (per metre depth in 2D); exactly equal for both ends
  double r2;      // r0², m²
  double energy;  // G V0_i w_ij, J
  Point area;     // a_ij
};

/// A bond or face term in the cancellation.
struct CancelledTerm {
  Point X;          // direction
  double strength;  // G V0_i w_ij, J
};

/// Point where a bond enters a clamp.
struct ClampPlace {
  Point x;     // at the start, m
  int behind;  // id of the rigid end of the bond
};

/// Constants computed once; particles are numbered by id. `initial` must outlive it.
struct BondedSetup {
  const InitialParticles& initial;
  std::vector<Elasticity> materials;
  Bonds bonds;               // with constraints, volumes and masses over density
  std::vector<double> mass;  // [n] kg (per metre depth in 2D)
  Interfaces interfaces;
  double wave_speed;                     // m/s, maximum of compression waves and interfaces
  double damping_lead;                   // 3 τ of the bonds, s
  std::vector<ClampPlace> clamp_places;  // by particle
  std::vector<int> first_clamp_place;    // [n]

  std::vector<BondConstants> bond_constants(int i) const;
  std::vector<CancelledTerm> cancelled_terms(int i) const;
};

/// `damping`: see BondedConstants.
BondedSetup make_bonded_setup(const SolverInput& input, double damping);

/// Returns the particles with all rigid ones marked as held, because loads act only on others.
InitialParticles with_rigid_held(const InitialParticles& initial, const Bonds& bonds);

}  // namespace taut
