#pragma once

#include <vector>

#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/layout/interfaces.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// G: modulus_of_bond.
struct BondConstants {
  int j;          // id of the other end; −1 − p: clamp place p
  double k;       // G (V0_i w_ij + V0_j w_ji)/r0² in N/m; bit-identical for both ends
  double r2;      // r0² in m²
  double energy;  // G V0_i w_ij in J
  Point area;     // a_ij, up to the factor that B removes (THEORY.md)
};

/// Bond or face term (THEORY.md, Cancellation). G: modulus_of_bond, for face terms modulus_of_bonds.
struct CancelledTerm {
  Point X;          // initial vector to the neighbour, or t of a face term, m; only the direction counts
  double strength;  // G V0_i w_ij in J
};

/// End of a bond into a rigid region.
struct ClampPlace {
  Point x;             // at the start, m
  int rigid_particle;  // id
};

/// Arrays by id. `initial` must outlive the setup.
struct BondedSetup {
  const InitialParticles& initial;
  std::vector<Elasticity> materials;
  Bonds bonds;
  std::vector<double> mass;  // [n] kg
  Interfaces interfaces;
  double wave_speed;                     // m/s
  double damping_lead;                   // 3 τ in s (THEORY.md, Damping)
  std::vector<ClampPlace> clamp_places;  // sorted by the particle whose bond ends there
  std::vector<int> first_clamp_place;    // [n]

  std::vector<BondConstants> bond_constants(int i) const;
  std::vector<CancelledTerm> cancelled_terms(int i) const;
};

BondedSetup make_bonded_setup(const SolverInput& input, double damping);

/// Copy in which exactly the rigid particles are clamped.
InitialParticles with_rigid_clamped(const InitialParticles& initial, const Bonds& bonds);

}  // namespace taut
