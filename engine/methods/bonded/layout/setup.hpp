#pragma once

#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/layout/interfaces.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// A bond with its constants, as the particle sums over it.
struct BondConstants {
  int j;          // id of the other end; −1 − p: the bond ends at clamp place p
  double k;       // G (V0_i w_ij + V0_j w_ji)/r0², N/m (per metre depth in 2D); the same bits from both ends
  double r2;      // r0², m²
  double energy;  // G V0_i w_ij, J
  Point area;     // a_ij
};

/// A term that a particle cancels: a bond or a face term.
struct CancelledTerm {
  Point X;          // its direction
  double strength;  // G V0_i w_ij, J
};

/// The point where a bond enters a clamp.
struct ClampPlace {
  Point x;     // at the start, m
  int behind;  // id of the rigid particle that the bond would lead to
};

/// All that the bonded family computes once, in the order in which each member follows from the ones before. Particles
/// are numbered by id. `initial` must outlive it.
struct BondedSetup {
  const InitialParticles& initial;
  std::vector<Elasticity> materials;
  Bonds bonds;               // with constraints, volumes and masses over density
  std::vector<double> mass;  // [n] kg (per metre depth in 2D)
  Interfaces interfaces;
  double wave_speed;                     // m/s, of compression in the stiffest material, or at an interface
  double damping_lead;                   // s, 3 τ of the bonds
  std::vector<ClampPlace> clamp_places;  // by the particle whose bond enters there
  std::vector<int> first_clamp_place;    // [n]

  std::vector<BondConstants> bond_constants(int i) const;
  std::vector<CancelledTerm> cancelled_terms(int i) const;
};

/// `damping`: see BondedConstants.
BondedSetup make_bonded_setup(const SolverInput& input, double damping);

/// Returns the particles with all rigid ones marked as held, for loads, which act on the others.
InitialParticles with_rigid_held(const InitialParticles& initial, const Bonds& bonds);

}  // namespace taut
