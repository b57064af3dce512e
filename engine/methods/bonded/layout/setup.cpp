#include "engine/methods/bonded/layout/setup.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace taut {
namespace {

constexpr double round_off = 1e-9;  // the end correction keeps the mass of a body of one material

/// Returns −1 if the bond is not stored.
int find_bond(const Bonds& bonds, int from, int to) {
  const int* const last = bonds.j.data() + bonds.begin[from + 1];
  const int* const found = std::find(bonds.j.data() + bonds.begin[from], last, to);
  return found == last ? -1 : static_cast<int>(found - bonds.j.data());
}

/// Masses, kg (THEORY.md, Volumes and masses).
std::vector<double> masses(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                           const Bonds& bonds) {
  struct Volumes {
    double cells = 0, corrected = 0;  // m³
  };
  std::map<std::pair<int, int>, Volumes> parts;  // by body and material
  const auto part_of = [&](int i) -> Volumes& { return parts[{initial.body[i], initial.material[i]}]; };
  for (int i = 0; i < initial.size(); ++i)
    part_of(i).cells += initial.V0[i], part_of(i).corrected += bonds.mass[i];
  std::vector<double> mass;
  mass.reserve(initial.V0.size());
  for (int i = 0; i < initial.size(); ++i) {
    mass.push_back(materials[initial.material[i]].rho0 * initial.V0[i]);
    if (initial.dim == 2 || bonds.is_rigid(i)) continue;
    mass.back() *= bonds.mass[i] / initial.V0[i];
    const auto& [cells, corrected] = part_of(i);
    if (std::abs(corrected - cells) > round_off * cells) mass.back() *= cells / corrected;
  }
  return mass;
}

double greatest_wave_speed(const InitialParticles& initial, const std::vector<Elasticity>& materials,
                           const Interfaces& interfaces) {
  double greatest = interfaces.wave_speed;
  for (const int used : initial.material)
    greatest = std::max(greatest, compression_wave_speed(materials[used]));
  return greatest;
}

double damping_lead(const InitialParticles& initial, const std::vector<Elasticity>& materials, double damping,
                    double dp) {
  double shear_speed = 0, greatest_share = 0;  // m/s; maximum of modulus_of_bonds/G
  for (const int used : initial.material) {
    const Elasticity& m = materials[used];
    shear_speed = std::max(shear_speed, std::sqrt(m.G / m.rho0));
    greatest_share = std::max(greatest_share, modulus_of_bonds(initial.dim, m) / m.G);
  }
  return 3 * damping * dp / (shear_speed * greatest_share);
}

void add_clamp_places(const Scene& scene, BondedSetup& setup) {
  const InitialParticles& initial = setup.initial;
  const Bonds& bonds = setup.bonds;
  setup.first_clamp_place.reserve(initial.V0.size());
  for (int i = 0; i < initial.size(); ++i) {
    setup.first_clamp_place.push_back(static_cast<int>(setup.clamp_places.size()));
    for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b) {
      const int j = bonds.j[b];
      if (!bonds.is_rigid(j) || find_bond(bonds, j, i) >= 0) continue;
      const ReferenceBond bond = bonds.of(i, b);
      Point x = initial.x[i];
      for (int k = 0; k < initial.dim; ++k) x[k] += bond.X[k];
      setup.clamp_places.push_back({displaced(scene.bodies[initial.body[i]], x), j});
    }
  }
}

}  // namespace

std::vector<BondConstants> BondedSetup::bond_constants(int i) const {
  std::vector<BondConstants> out;
  out.reserve(bonds.begin[i + 1] - bonds.begin[i]);
  int place = first_clamp_place[i];
  for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b) {
    const ReferenceBond own = bonds.of(i, b);
    BondConstants bond{bonds.j[b], 0, 0, 0, own.area};
    for (int d = 0; d < initial.dim; ++d) bond.r2 += own.X[d] * own.X[d];
    const int back = find_bond(bonds, bonds.j[b], i);
    const double G = modulus_of_bond(bonds, initial, materials, i, b),
                 w_ji = back < 0 ? 0 : bonds.of(bonds.j[b], back).weight;  // clamp places have no energy
    bond.energy = G * initial.V0[i] * own.weight;
    bond.k = (bond.energy + G * initial.V0[bonds.j[b]] * w_ji) / bond.r2;
    if (back < 0) bond.j = -1 - place++;
    out.push_back(bond);
  }
  return out;
}

std::vector<CancelledTerm> BondedSetup::cancelled_terms(int i) const {
  std::vector<CancelledTerm> out;
  out.reserve(bonds.begin[i + 1] - bonds.begin[i]);
  for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b) {
    const ReferenceBond bond = bonds.of(i, b);
    out.push_back({bond.X, modulus_of_bond(bonds, initial, materials, i, b) * initial.V0[i] * bond.weight});
  }
  const double own = modulus_of_bonds(initial.dim, materials[initial.material[i]]);
  for (const FaceTerm& term : bonds.face_terms_of(i))
    out.push_back({term.t, own * initial.V0[i] * term.weight});
  return out;
}

BondedSetup make_bonded_setup(const SolverInput& input, double damping) {
  const InitialParticles& initial = input.initial;
  const std::vector<Elasticity>& materials = input.materials;
  Bonds bonds = make_bonds(input.scene, initial, make_constraints(input.scene, initial), input.constants.h,
                           input.threads);
  std::vector<double> mass = masses(initial, materials, bonds);
  Interfaces interfaces = make_interfaces(initial, materials, bonds, input.constants.dp);
  const double wave_speed = greatest_wave_speed(initial, materials, interfaces),
               lead = damping_lead(initial, materials, damping, input.constants.dp);
  BondedSetup setup{
      initial, materials, std::move(bonds), std::move(mass), std::move(interfaces), wave_speed, lead, {}, {}};
  add_clamp_places(input.scene, setup);
  return setup;
}

InitialParticles with_rigid_clamped(const InitialParticles& initial, const Bonds& bonds) {
  InitialParticles out = initial;
  for (int i = 0; i < out.size(); ++i) out.clamped[i] = bonds.is_rigid(i);
  return out;
}

}  // namespace taut
