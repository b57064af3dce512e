#include "engine/methods/bonded/solver.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.hpp"
#include "engine/methods/bonded/describe.hpp"
#include "engine/methods/bonded/layout/layout_stiffness.hpp"
#include "engine/solver/particle_simulation.hpp"

namespace taut {

template <int Dim>
Bonded<Dim>::Bonded(Common<Dim>& common, const SolverInput& input, const Kernels& kernels,
                    const BondedSetup& setup)
    : kernels_(kernels),
      common_(common),
      p_(common.particles),
      c_(common.constants),
      materials_(input.materials),
      uses_group_law_(input.law == as<BondedFormulation>(input.method)->law),
      laws_(input.law, input.materials),
      constraints_(setup.bonds.constraints),
      wave_speed_(setup.wave_speed),
      bonds_(stored(setup)),
      interfaces_(setup, p_.id),
      half_cells_(setup, p_.id) {
  common_.run.lawful_stretch = std::sqrt(cancelled_range<Dim>[1]);
  common_.run.pairs = static_cast<long>(setup.bonds.j.size());
  for (int i = 0; i < p_.size(); ++i) {
    p_.m[i] = setup.mass[p_.id[i]];
    material_.push_back(common_.initial.material[p_.id[i]]);
  }
  material_.resize(lanes * group_count());
  Loads<Dim>& loads = common_.external.loads;
  if (Dim == 3) loads.spread_by(setup.bonds.mass, input.scene, common_.initial);
  add_group_constants(setup.bonds);
  common_.go_to_start();
  f_.lead = setup.damping_lead;
  make_columns(setup);
  // thin 3D lattices have faster modes than large lattices
  if (setup.bonds.off_lattice || Dim == 3) find_layout_frequency();
  // not `uniform`: no choice of bonds keeps a uniform stress in equilibrium at corners
  if (has_loads(input.scene))
    loads.act_on_faces(input.scene, with_rigid_clamped(common_.initial, setup.bonds), FaceRule::by_column,
                       surface(setup.bonds), common_.run.support);
  common_.contact.search(p_);
  common_.show_contacts_to_probes();
}

template <int Dim>
double Bonded<Dim>::damping_of(const SolverInput& input) {
  const auto& method = *as<BondedFormulation>(input.method);
  return constants_of(bonded::constants(method, Dim), input.constants, input.values).damping;
}

template <int Dim>
auto Bonded<Dim>::stored(const BondedSetup& setup) const -> AnyBonds {
  const int threads = common_.run.threads;
  const auto with = [&]<class Storage>(Storage) -> AnyBonds {
    return StoredBonds<Dim, Storage>{PackedBonds<Dim, Storage>(setup, p_.id, threads),
                                     CancelledBonds<Dim, Storage>(p_.size(), threads, [&](int i) {
                                       return setup.cancelled_terms(p_.id[i]);
                                     })};
  };
  if constexpr (Dim == 3)
    if (setup.bonds.off_lattice) return with(HalfPack{});
  return with(AlignedPack{});
}

template <int Dim>
void Bonded<Dim>::add_group_constants(const Bonds& bonds) {
  struct GroupConstants {
    std::vector<GroupLaw> laws{GroupLaw{}};
    std::vector<Mat<Pack, Dim>> B{Mat<Pack, Dim>{}};
  };
  const auto make = [&](int group) {
    GroupConstants all;
    GroupLaw& four = all.laws[0];
    Mat<Pack, Dim>& B = all.B[0];
    for (int lane = 0; lane < lanes && lanes * group + lane < p_.size(); ++lane) {
      const int id = p_.id[lanes * group + lane];
      const Elasticity& material = materials_[common_.initial.material[id]];
      four.law.K[lane] = material.K, four.law.G[lane] = material.G;
      for (int a = 0; a < Dim; ++a)
        for (int k = 0; k < Dim; ++k) B(k, a)[lane] = bonds.B[id][a][k];
      if (B(0, 0)[lane] > 0) four.V[lane] = bonds.volume[id];
    }
    return all;
  };
  make_in_order(group_count(), common_.run.threads, make, [&](int, const GroupConstants& all) {
    groups_.push_back({group_laws_.add(all.laws), B_.add(all.B)});
  });
  group_laws_.close(), B_.close();
}

template <int Dim>
void Bonded<Dim>::make_columns(const BondedSetup& setup) {
  clamps_.add_places(setup.clamp_places, p_, common_.external.drives, places_, Q_);
  mobility_.resize(p_.size());
  bond_force_.resize(group_count());
  bind_fields();
  for (int i = 0; i < p_.size(); ++i) f_.set_place(i), mobility_[0][i] = p_.mobile[i] / p_.m[i];
}

template <int Dim>
void Bonded<Dim>::bind_fields() {
  f_ = {.size = p_.size(),
        .x = p_.x.data(),
        .v = p_.v.data(),
        .places = places_,
        .Q = Q_,
        .mobility = mobility_[0],
        .bond_force = bond_force_.data(),
        .lead = f_.lead,
        .least_r2 = 1e-4 * c_.dp * c_.dp,
        .uses_group_law = uses_group_law_,
        .laws = laws_.in_use(),
        .material = material_.data(),
        .groups = groups_.data(),
        .group_laws = group_laws_.from(0),
        .B = B_.from(0),
        .bonds = {},
        .halved_bonds = {},
        .halved = bonds_.index() > 0};
  if (const auto* whole = std::get_if<0>(&bonds_)) f_.bonds = whole->view();
  if constexpr (Dim == 3)
    if (const auto* halved = std::get_if<1>(&bonds_)) f_.halved_bonds = halved->view();
}

/// In s (THEORY.md, Stability limit).
template <int Dim>
double Bonded<Dim>::step_size() const {
  constexpr double spare = 1.5;
  const double stiffer = std::sqrt(std::max(1.0, layout_ * stiffest_ / spare));
  return common_.fixed_or_stable_step(c_.cfl * c_.dp / (wave_speed_ + common_.vmax) / stiffer);
}

template <int Dim>
void Bonded<Dim>::find_layout_frequency() {
  constexpr double small = 1e-5, limit = 0.97;  // displacement in spacings; `cfl` limit of a lattice
  const int n = p_.size(), threads = common_.threads_now();
  const std::vector<double> mobility(mobility_[0], mobility_[0] + n);
  std::vector<V> displaced = p_.x;
  BondedFields<Dim> moved = f_;
  moved.x = displaced.data();
  const auto forces = [&](const std::vector<V>& u, std::vector<V>& out) {
    parallel_for(n, threads, [&](int i) {
      displaced[i] = p_.x[i] + u[i];
      moved.set_place(i);
    });
    kernels_.stresses(moved, threads);
    kernels_.inner_forces(moved, out.data(), threads);
  };
  const double square = highest_frequency_squared<Dim>(mobility, small * c_.dp, threads, forces),
               of_lattice = 2 * wave_speed_ / (limit * c_.dp);
  layout_ = std::max(1.0, square / (of_lattice * of_lattice));
  for (int i = 0; i < n; ++i) f_.set_place(i);
}

template <int Dim>
void Bonded<Dim>::step(double dt) {
  const int threads = common_.threads_now();
  if (common_.contact.prepare(p_, common_.vmax * dt)) common_.show_contacts_to_probes();
  kernels_.half_drift(f_, 0.5 * dt, threads);
  clamps_.follow(p_, f_.lead, places_);
  common_.contact.evaluate(p_, dt, threads);
  stiffest_ = kernels_.stresses(f_, threads);
  interfaces_.pass(p_.x, law_of_one(), threads, Q_, bond_force_);
  half_cells_.pass(p_.x, law_of_one(), threads, Q_);
  if (clamps_.has_driven() || common_.external.reactions.active()) pull_at_clamps();
  const Kick<Dim> kick = common_.kick(dt, common_.run.time + dt);
  common_.set_greatest_speed(kernels_.forces(f_, kick, threads));
  common_.stop_approach(0.5 * dt, [&](int i, const V& change) { p_.x[i] += (0.5 * dt) * change; });
  common_.finish_step(dt);
}

/// Adds to each rigid particle the force of its bonds.
template <int Dim>
void Bonded<Dim>::pull_at_clamps() {
  const auto pull_at = [&](int i, const V& pull) {
    for (int k = 0; k < Dim; ++k) bond_force_[i / lanes][k][i % lanes] -= pull[k];
  };
  std::visit(
      [&](const auto& bonds) { clamps_.for_each_pull(bonds.packed, places_, Q_, f_.least_r2, pull_at); },
      bonds_);
}

template <int Dim>
void Bonded<Dim>::renew_recovered() const {
  std::vector<int> drive = common_.initial.drive;  // −1 after its end
  long released = 0;
  for (std::size_t id = 0; id < drive.size(); ++id)
    if (drive[id] >= 0 && !common_.external.drives.moves(static_cast<int>(id))) drive[id] = -1, ++released;
  if (released == released_ && !recovered_.empty()) return;
  released_ = released;
  recovered_ = recovered_gradient(common_.initial, constraints_, drive, p_.id, c_.dp, common_.run.support,
                                  common_.run.threads, f_.halved);
}

/// Fields with current `places`; `step` leaves f_.places at mid-step.
template <int Dim>
BondedFields<Dim> Bonded<Dim>::fields_now(Columns<2 * Dim>& places) const {
  places.resize(places_.size());
  for (int k = 0; k < 2 * Dim; ++k)
    std::copy(places_[k] + lanes * group_count(), places_[k] + places_.size(),
              places[k] + lanes * group_count());
  BondedFields<Dim> now = f_;
  now.places = places;
  parallel_for(p_.size(), common_.threads_now(), [&](int i) { now.set_place(i); });
  clamps_.follow(p_, f_.lead, places);
  return now;
}

template <int Dim>
bool Bonded<Dim>::show_motion(Snapshot& out) const {
  common_.begin_motion(out);
  out.strain_energy.resize(out.size());
  Columns<2 * Dim> places;
  std::vector<AlignedPack> energies(group_count());
  kernels_.energies(fields_now(places), energies.data(), common_.threads_now());
  parallel_for(p_.size(), common_.threads_now(), [&](int i) {
    common_.store_motion(out, i);
    out.strain_energy[p_.id[i]] = energies[i / lanes].value[i % lanes] + energy_change(i);
  });
  return true;
}

template <int Dim>
void Bonded<Dim>::show(Snapshot& out, std::span<const int> groups) const {
  const int threads = common_.threads_now(), count = static_cast<int>(groups.size());
  renew_recovered();
  out.strain_energy.resize(out.size());
  Columns<2 * Dim> places;
  const BondedFields<Dim> now = fields_now(places);
  std::vector<AlignedPack> displacements(p_.x.size());  // padding is 0
  parallel_for(p_.size(), threads, [&](int i) {
    for (int k = 0; k < Dim; ++k) displacements[i].value[k] = p_.x[i][k] - common_.initial.x[p_.id[i]][k];
  });
  std::vector<ShownGroup<Dim>> shown(groups.size());
  kernels_.show(now, recovered_.view(), displacements.data(), groups.data(), count, shown.data(), threads);
  parallel_for(count, threads, [&](int k) {
    const auto& [stress, energy] = shown[k];
    for (int i = lanes * groups[k], lane = 0; lane < lanes && i < p_.size(); ++i, ++lane) {
      out.strain_energy[p_.id[i]] = energy[lane] + energy_change(i);
      ShownStress<double, Dim> one{stress.J[lane], stress.p[lane], {}, stress.s_zz[lane]};
      for (int c = 0; c < Sym<double, Dim>::size; ++c) one.s.c[c] = stress.s.c[c][lane];
      if (half_cells_.contains(i))
        one = laws_.visit(material_[i], [&](const auto& law) {
          return shown_stress(law, half_cells_.deformation_at(i, p_.x));
        });
      common_.store(out, i, materials_[material_[i]].rho0 / one.J, one.p, one.s, one.s_zz);
    }
  });
}

std::unique_ptr<Simulation> bonded::make(const SolverInput& input) {
  const auto made = [&]<int Dim>() {
    const auto& kernels = kernels_for<Family::bonded, BondedKernels<Dim>>(input);
    return simulation_by<Bonded<Dim>, Dim>(input, greatest_bond_reach * input.constants.h, kernels);
  };
  return input.scene.dim == 3 ? made.template operator()<3>() : made.template operator()<2>();
}

}  // namespace taut
