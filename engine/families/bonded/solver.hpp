#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/core/shared_rows.hpp"
#include "engine/families/bonded/bond_sums.hpp"
#include "engine/families/bonded/bonds.hpp"
#include "engine/families/bonded/closed_law.hpp"
#include "engine/families/bonded/interface_sites.hpp"
#include "engine/families/bonded/layout_stiffness.hpp"
#include "engine/families/bonded/pins.hpp"
#include "engine/families/bonded/recovered_gradient.hpp"
#include "engine/families/bonded/shown_stress.hpp"
#include "engine/solver/particle_solver.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

/// Bodies held together by bonds (terms/bond.hpp), which touch by a contact law. Position Verlet, so that
/// without damping the energy has no drift.
///
/// Two passes a step over groups of four particles, one a lane. The stress pass visits x_j and v_j and gives
/// F_i, the bonds' force and Q_i = T_i B_i, from which the force pass makes that of all stresses: with
/// g_ij = B_i a_ij and a_ij = −a_ji it is
///   Σ_j (T_i g_ij − T_j g_ji) = Σ_j (Q_i + Q_j) a_ij,
/// so that the passes share one vector a bond, and each visits a few columns of its neighbours.
template <const Formulation& M, int Dim>
class Bonded final : public ParticleSolver<Bonded<M, Dim>, Dim> {
 public:
  explicit Bonded(const SolverInput& input)
      : Base(input, greatest_bond_reach * input.constants.h),
        materials_(input.materials),
        own_law_(input.law == M.law),
        laws_(input.law, input.materials),
        least_r2_(filled<Pack>(1e-4 * c_.dp * c_.dp)) {
    double shear_speed = 0, of_G = 0;  // of_G: the greatest share of G that bonds have
    for (const int used : this->initial_.material) {
      const Elasticity& m = materials_[used];
      wave_speed_ = std::max(wave_speed_, compression_wave_speed(m));
      shear_speed = std::max(shear_speed, std::sqrt(m.G / m.rho0));
      of_G = std::max(of_G, bond_modulus<Dim>(m.K, m.G) / m.G);
    }
    ahead_ = 3 * c_.damping * c_.dp / (shear_speed * of_G);
    this->lawful_stretch_ = std::sqrt(cancelled_range<Dim>[1]);
    // a clamp that moves; on faces the half cells before it are part of the body, and show their stress
    for (int id = 0; id < s_.size(); ++id)
      if (this->drives_.lasts(id) && !input.scene.bodies[s_.body[id]].on_boundary)
        this->initial_.held[id] = 1;
    for (const int pin : pins(this->initial_, c_.dp)) this->initial_.held[pin] = 0;  // it keeps its place
    const Bonds bonds = make_bonds(input.scene, this->initial_, c_.h, input.threads);
    this->pairs_ = static_cast<long>(bonds.j.size());
    take_masses(bonds);
    if (Dim == 3) this->loads_.spread_by(bonds.mass, input.scene, this->initial_);
    Base::go_to_start();
    hold(bonds, input.scene);
    add_sites(bonds);
    const Interfaces interfaces = make_interfaces(this->initial_, materials_, bonds, c_.dp);
    wave_speed_ = std::max(wave_speed_, interfaces.wave_speed);
    interfaces_ = InterfaceSites<Dim>(interfaces, bonds, this->initial_, materials_, s_.id);
    make_columns();
    for (const int id : s_.id) material_.push_back(this->initial_.material[id]);
    material_.resize(lanes * group_count());
    // in 3D a lattice three particles across, or four near incompressibility, swings faster than the solid
    if (bonds.off_lattice || Dim == 3) find_stiffest_swing();
    // not what a corner takes from a uniform stress, since there the bonds have no choice that is right
    if (has_loads(input.scene))
      this->loads_.act_on_faces(input.scene, this->initial_, FaceRule::by_column, surface(bonds),
                                this->support_);
    contact_.search(s_);
    Base::show_contacts_to_probes();
    Base::record();
  }

  double step_size() const;
  void step(double dt);
  void prepare_to_show();
  void show(int group);
  template <class Archive>
  void serialize(Archive& archive) {
    Base::serialize(archive);
    archive(stiffest_);
  }

 private:
  using Base = ParticleSolver<Bonded<M, Dim>, Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::threads_now, Base::vmax_;
  using typename Base::V;

  struct Sites {  // four particles; the filling and what is held has V = 0
    Pack V;       // m^Dim, with which the energy counts
    ClosedNeoHookean<Pack> law;
  };
  using GradientMoment = Mat<Pack, Dim>;
  struct Group {  // where to find its
    int sites, B;
  };
  struct Strained {        // of four particles
    Mat<Pack, Dim> F;      // 0 where there is no volume
    Vec<Pack, Dim> force;  // of the bonds, N
    Pack energy;           // of the bonds, J; if asked for
    Pack stiffest;         // of bonds and particles, over that at rest
    Pack root;             // of the law, if it is the own one
  };

  // in 3D off a lattice, where each particle has constants of its own, in half the bytes
  using AnyBonds = std::conditional_t<Dim == 2, std::variant<HeldBonds<Dim, StoredPack>>,
                                      std::variant<HeldBonds<Dim, StoredPack>, HeldBonds<Dim, HalfPack>>>;

  void hold(const Bonds& bonds, const Scene& scene);
  template <class Kept>
  HeldBonds<Dim, Kept> held(const Bonds& bonds, const Scene& scene) const;
  void add_sites(const Bonds& bonds);
  void make_columns();
  void take_masses(const Bonds& bonds);
  void find_stiffest_swing();
  void half_drift(double dt);
  void stress_pass();
  template <class Kept>
  Vec<Pack, Dim> force(const HeldBonds<Dim, Kept>& bonds, int group) const;
  double force_pass(double dt);
  template <bool WithEnergy, class Kept>
  void strain(const HeldBonds<Dim, Kept>& bonds, int group, Strained& out) const;
  template <class Kept>
  void set_stress(const HeldBonds<Dim, Kept>& bonds, int group, const Strained& now);
  [[gnu::noinline]] Mat<Pack, Dim> piola_of_chosen_law(int group, const Mat<Pack, Dim>& F) const;
  template <class Kept>
  Pack energy_of_four(const HeldBonds<Dim, Kept>& bonds, int group, const Mat<Pack, Dim>& F) const;
  void show_stress(int group, const Mat<Pack, Dim>& F);
  [[gnu::noinline]] void pull_at_clamps();
  LawOfOne<M> law_of_one() const { return {materials_, own_law_, laws_}; }
  const Sites& sites(int group) const { return sites_[groups_[group].sites]; }
  const GradientMoment& B(int group) const { return B_[groups_[group].B]; }
  void set_place(int i) { set_place(i, s_.x[i]); }
  void set_place(int i, const V& x) {
    const V v = s_.v[i];
    for (int k = 0; k < Dim; ++k) places_[k][i] = x[k], places_[Dim + k][i] = x[k] + ahead_ * v[k];
  }
  static constexpr int block = 8;  // groups
  int block_count() const { return (group_count() + block - 1) / block; }
  int group_count() const { return (s_.size() + lanes - 1) / lanes; }

  std::vector<Elasticity> materials_;
  bool own_law_;  // that of Sites
  ChosenLaws<M> laws_;
  std::vector<int> material_;  // with the filling of the last group
  Pack least_r2_;              // m²: bonds shorter than a hundredth of a spacing are taken for that long
  double wave_speed_ = 0;      // m/s, of compression in the stiffest material, or at an interface
  double ahead_ = 0;           // s, 3 τ of the bonds
  double layout_ = 1;    // ω² of the stiffest swing at the start over that of a lattice, if it is greater
  double stiffest_ = 1;  // greatest of all bonds and particles in the last step, over that at rest
  SharedRows<Sites> sites_;
  SharedRows<GradientMoment> B_;
  std::vector<Group> groups_;
  AnyBonds bonds_;
  InterfaceSites<Dim> interfaces_;
  Clamps<Dim> clamps_;
  Columns<2 * Dim> places_;                 // x, x + 3 τ v
  Columns<Dim * Dim> Q_;                    // row by row
  Columns<1> mobility_;                     // 1/m of what may move, 1/kg
  std::vector<Vec<Pack, Dim>> bond_force_;  // N, of each group
  RecoveredGradient recovered_;             // once a snapshot has asked for it
  std::vector<StoredPack> displacements_;   // of the last snapshot, m; the last lanes are 0
};

/// In 2D a particle is as heavy as its cell; in 3D see bonds.hpp.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::take_masses(const Bonds& bonds) {
  if (Dim == 2) return;
  for (int i = 0; i < s_.size(); ++i)
    if (const int id = s_.id[i]; !this->initial_.held[id]) s_.m[i] *= bonds.mass[id] / this->initial_.V0[id];
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::hold(const Bonds& bonds, const Scene& scene) {
  if constexpr (Dim == 3)
    if (bonds.off_lattice) bonds_ = held<HalfPack>(bonds, scene);
  if (bonds_.index() == 0) bonds_ = held<StoredPack>(bonds, scene);
}

template <const Formulation& M, int Dim>
template <class Kept>
HeldBonds<Dim, Kept> Bonded<M, Dim>::held(const Bonds& bonds, const Scene& scene) const {
  using Cancelled = CancelledBonds<Dim, Kept>;
  const auto cancelled = [&](int i) {
    std::vector<typename Cancelled::Bond> of_particle;
    const int id = s_.id[i];
    of_particle.reserve(bonds.begin[id + 1] - bonds.begin[id]);
    for (int b = bonds.begin[id]; b < bonds.begin[id + 1]; ++b) {
      const taut::Bond& bond = bonds.of(id, b);
      const double G = bond_modulus<Dim>(bonds, this->initial_, materials_, id, b);
      of_particle.push_back(Cancelled::along(bond.X, G * this->initial_.V0[id] * bond.weight));
    }
    const Elasticity& own = materials_[this->initial_.material[id]];
    for (const FaceTerm& term : bonds.face_terms_of(id))
      of_particle.push_back(
          Cancelled::along(term.t, bond_modulus<Dim>(own.K, own.G) * this->initial_.V0[id] * term.weight));
    return of_particle;
  };
  return {PackedBonds<Dim, Kept>(bonds, scene, this->initial_, materials_, s_.id, this->threads_),
          Cancelled(s_.size(), this->threads_, cancelled)};
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::add_sites(const Bonds& bonds) {
  struct Four {
    std::vector<Sites> sites{Sites{}};
    std::vector<GradientMoment> B{GradientMoment{}};
  };
  const auto make = [&](int group) {
    Four all;
    Sites& four = all.sites[0];
    GradientMoment& B = all.B[0];
    for (int lane = 0; lane < lanes && lanes * group + lane < s_.size(); ++lane) {
      const int id = s_.id[lanes * group + lane];
      const Elasticity& material = materials_[this->initial_.material[id]];
      four.law.K[lane] = material.K, four.law.G[lane] = material.G;
      for (int a = 0; a < Dim; ++a)
        for (int k = 0; k < Dim; ++k) B(k, a)[lane] = bonds.B[id][a][k];
      if (B(0, 0)[lane] > 0) four.V[lane] = bonds.volume[id];
    }
    return all;
  };
  make_in_order(group_count(), this->threads_, make, [&](int, const Four& all) {
    groups_.push_back({sites_.add(all.sites), B_.add(all.B)});
  });
  sites_.close(), B_.close();
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::make_columns() {
  std::visit([&](const auto& bonds) { clamps_.add_places(bonds.packed, s_, this->drives_, places_, Q_); },
             bonds_);
  mobility_.resize(s_.size());
  for (int i = 0; i < s_.size(); ++i) set_place(i), mobility_[0][i] = s_.mobile[i] / s_.m[i];
  bond_force_.resize(group_count());
}

/// s. [Zhang2024] Eq. 22 with the speed of compression waves, for any ν, and with dp, on which the limit
/// depends and not on h. A bond that is pressed or pulled gets stiffer, and so does a particle whose J is
/// below one half; steps get shorter once that, and a layout whose stiffest swing is faster than a lattice's,
/// take up most of what a `cfl` of 0.64 leaves to the limit of 0.97.
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::step_size() const {
  constexpr double spare = 1.5;
  const double stiffer = std::sqrt(std::max(1.0, layout_ * stiffest_ / spare));
  return Base::fixed_or(c_.cfl * c_.dp / (wave_speed_ + vmax_) / stiffer);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::find_stiffest_swing() {
  constexpr double small = 1e-5, limit = 0.97;  // spacings; of cfl, of a lattice
  const int n = s_.size(), threads = threads_now();
  const std::vector<double> mobility(mobility_[0], mobility_[0] + n);
  const auto forces = [&](const std::vector<V>& u, std::vector<V>& out) {
    parallel_for(n, threads, [&](int i) { set_place(i, s_.x[i] + u[i]); });
    stress_pass();
    const auto add_up = [&](const auto& bonds) {
      parallel_for(group_count(), threads, [&](int group) {
        const Vec<Pack, Dim> f = force(bonds, group);
        for (int i = lanes * group, lane = 0; lane < lanes && i < n; ++i, ++lane) out[i] = lane_of(f, lane);
      });
    };
    std::visit(add_up, bonds_);
  };
  const double square = stiffest_swing<Dim>(mobility, small * c_.dp, threads, forces),
               of_lattice = 2 * wave_speed_ / (limit * c_.dp);
  layout_ = std::max(1.0, square / (of_lattice * of_lattice));
  stiffest_ = 1;
  for (int i = 0; i < n; ++i) set_place(i);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::step(double dt) {
  if (contact_.prepare(s_, vmax_ * dt)) Base::show_contacts_to_probes();
  half_drift(dt);
  contact_.evaluate(s_, dt, threads_now());
  stress_pass();
  interfaces_.pass(s_.x, law_of_one(), threads_now(), Q_, bond_force_);
  if (clamps_.are_driven() || this->reactions_.active()) pull_at_clamps();
  Base::set_greatest_speed(force_pass(dt));
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) { s_.x[i] += (0.5 * dt) * change; });
  Base::finish_step(dt);
}
inline constexpr TermInfo bonded_time_info{
    "time", "position Verlet, one step", "[Zhang2024] Eq. 22–25", "families/bonded/solver.hpp:step",
    "oenog: 40 steps are those of the formulas, with a clamp, two materials and on a ring"};

/// The first half of x, into the columns too.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::half_drift(double dt) {
  parallel_for(group_count(), threads_now(), [&](int group) {
    const int first = lanes * group;
    if (first + lanes > s_.size()) {
      for (int i = first; i < s_.size(); ++i) s_.x[i] += (0.5 * dt) * s_.v[i], set_place(i);
      return;
    }
    Pack x_rows[Dim], v_rows[Dim], x[Dim], v[Dim];
    double* const x_at = reinterpret_cast<double*>(&s_.x[first]);  // of `lanes` particles, row by row
    const double* const v_at = reinterpret_cast<const double*>(&s_.v[first]);
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) {
      v_rows[k] = load(v_at + lanes * k);
      x_rows[k] = load(x_at + lanes * k) + (0.5 * dt) * v_rows[k];
      store(x_rows[k], x_at + lanes * k);
    }
    separate(x_rows, x), separate(v_rows, v);
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) {
      store(x[k], places_[k] + first);
      store(x[k] + ahead_ * v[k], places_[Dim + k] + first);
    }
  });
  clamps_.follow(s_, ahead_, places_);
}

template <const Formulation& M, int Dim>
template <bool WithEnergy, class Kept>
void Bonded<M, Dim>::strain(const HeldBonds<Dim, Kept>& bonds, int group, Strained& out) const {
  const BondSums<Dim> sums = bond_sums<WithEnergy>(bonds.packed, places_, group, least_r2_);
  const Mat<Pack, Dim> F = product_transposed(sums.A, B(group));
  for (int a = 0; a < Dim; ++a) {
    out.force[a] = sums.force[a];
    for (int k = 0; k < Dim; ++k) out.F(a, k) = F(a, k);
  }
  if constexpr (WithEnergy) out.energy = sums.energy;
  const Pack closing = sites(group).V > 0 ? closing_stiffness(determinant(F)) : Pack{};
  out.stiffest = max(Pack(sums.stiffest + bond_stiffness_offset), closing);
}

/// V_i W(F_i) less what is cancelled of the bonds, of four particles, J
template <const Formulation& M, int Dim>
template <class Kept>
Pack Bonded<M, Dim>::energy_of_four(const HeldBonds<Dim, Kept>& bonds, int group,
                                    const Mat<Pack, Dim>& F) const {
  const Sites& own = sites(group);
  Sym<Pack, Dim> C = right_cauchy_green(F);
  for (int k = 0; k < Dim; ++k) C(k, k) = own.V > 0 ? C(k, k) : filled<Pack>(1);
  const Pack W = own_law_ ? own.law.energy(F) : laws_.visit([&](const auto& laws) {
    return closed_energy(laws, &material_[lanes * group], F);
  });
  return own.V * W - bonds.cancelled.energy(group, C);
}

/// P of four particles, one after the other.
template <const Formulation& M, int Dim>
Mat<Pack, Dim> Bonded<M, Dim>::piola_of_chosen_law(int group, const Mat<Pack, Dim>& F) const {
  return laws_.visit([&](const auto& laws) { return closed_piola(laws, &material_[lanes * group], F); });
}

/// Q = T B
template <const Formulation& M, int Dim>
template <class Kept>
void Bonded<M, Dim>::set_stress(const HeldBonds<Dim, Kept>& bonds, int group, const Strained& now) {
  const Sites& own = sites(group);
  const Mat<Pack, Dim>& F = now.F;
  const Mat<Pack, Dim> P = own_law_ ? own.law.piola(F, now.root) : piola_of_chosen_law(group, F);
  const Mat<Pack, Dim> FS = product(F, bonds.cancelled.slopes(group, right_cauchy_green(F)));
  Mat<Pack, Dim> T;
  for (int a = 0; a < Dim; ++a)
    for (int k = 0; k < Dim; ++k) T(a, k) = own.V * P(a, k) - FS(a, k);
  const Mat<Pack, Dim> Q = product(T, B(group));
  for (int a = 0; a < Dim; ++a)
    for (int k = 0; k < Dim; ++k) store(Q(a, k), Q_[a * Dim + k] + lanes * group);
}

/// Block by block: while the long chain of operations that a root takes, or the law, is under way for one
/// group, those of others are begun, but not if all their bonds come in between.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::stress_pass() {
  const auto pass = [&](const auto& bonds) {
    return parallel_max(block_count(), threads_now(), [&](int n) {
      const int first = block * n, count = std::min(block, group_count() - first);
      Strained of[block];
      Pack stiffest{};
      for (int k = 0; k < count; ++k) {
        strain<false>(bonds, first + k, of[k]);
        for (int a = 0; a < Dim; ++a) bond_force_[first + k][a] = of[k].force[a];
        stiffest = max(stiffest, of[k].stiffest);
      }
      for (int k = 0; own_law_ && k < count; ++k)
        of[k].root = ClosedNeoHookean<Pack>::root(determinant(of[k].F));
      for (int k = 0; k < count; ++k) set_stress(bonds, first + k, of[k]);
      return greatest(stiffest);
    });
  };
  stiffest_ = std::visit(pass, bonds_);
}

/// f_i = that of the bonds + Σ_j (Q_i + Q_j) a_ij, of four particles.
template <const Formulation& M, int Dim>
template <class Kept>
Vec<Pack, Dim> Bonded<M, Dim>::force(const HeldBonds<Dim, Kept>& bonds, int group) const {
  Vec<Pack, Dim> f = bond_force_[group];
  add_stress_force(bonds.packed, Q_, group, f);
  return f;
}

/// v by all forces, and the second half of x. The greatest v², m²/s².
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::force_pass(double dt) {
  const typename Base::Kick kick(*this, dt, this->time_ + dt);
  const auto pass = [&](const auto& bonds) {
    if (kick.watched())
      parallel_for(group_count(), threads_now(),
                   [&](int group) { kick.note(lanes * group, force(bonds, group)); });
    return parallel_max(block_count(), threads_now(), [&](int n) {
      Pack fastest{};
      for (int group = block * n; group < std::min(block * (n + 1), group_count()); ++group) {
        const int first = lanes * group;
        Vec<Pack, Dim> f = force(bonds, group);
        kick.add_contact(first, f);
        const Pack mobility = dt * load(mobility_[0] + first);
        Pack change[Dim];
        for (int k = 0; k < Dim; ++k) change[k] = mobility * f[k];
        fastest = max_or_nan(fastest, kick.by_changes(first, change, 0.5 * dt));
      }
      return greatest(fastest);
    });
  };
  return std::visit(pass, bonds_);
}

/// What a bond into a clamp pulls at a free particle it pulls at the held or driven one: for the work of drives, and for
/// probes of reactions.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::pull_at_clamps() {
  const auto pull_at = [&](int i, const V& pull) {
    for (int k = 0; k < Dim; ++k) bond_force_[i / lanes][k][i % lanes] -= pull[k];
  };
  std::visit(
      [&](const auto& bonds) { clamps_.for_each_pull(bonds.packed, places_, Q_, least_r2_[0], pull_at); },
      bonds_);
}

/// The stress shown is that of the recovered F; none of a held particle, which is rigid. In 3D F is scaled to
/// the method's own volume: near incompressibility that of the recovered F, which no force keeps, is off. Not where the
/// own F is a mean of two sides.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::show_stress(int group, const Mat<Pack, Dim>& F) {
  const int first = group * lanes, count = std::min(lanes, s_.size() - first);
  const auto four = shown_neo_hookean(sites(group).law.K, sites(group).law.G, F);
  for (int lane = 0; lane < count; ++lane) {
    const double rho0 = materials_[material_[first + lane]].rho0;
    ShownStress<double, Dim> one{four.J[lane], four.p[lane], {}, four.s_zz[lane]};
    for (int k = 0; k < Sym<double, Dim>::size; ++k) one.s.c[k] = four.s.c[k][lane];
    if (!own_law_)
      one = laws_.visit(
          [&](const auto& laws) { return shown_stress(laws[material_[first + lane]], lane_of(F, lane)); });
    Base::store(first + lane, rho0 / one.J, one.p, one.s, one.s_zz);
  }
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::prepare_to_show() {
  // what a drive has let go is rigid no longer
  for (std::size_t id = 0; id < this->initial_.drive.size(); ++id)
    if (int& drive = this->initial_.drive[id]; drive >= 0 && !this->drives_.moves(static_cast<int>(id))) {
      drive = -1;
      recovered_ = {};
    }
  if (recovered_.empty())
    recovered_ = recovered_gradient(this->initial_, s_.id, c_.dp, this->support_, this->threads_,
                                    /*halved*/ bonds_.index() > 0);
  this->snapshot_.strain_energy.resize(s_.size());
  displacements_.resize(s_.size());
  parallel_for(s_.size(), threads_now(), [&](int i) {
    set_place(i);
    for (int k = 0; k < Dim; ++k) displacements_[i].value[k] = s_.x[i][k] - this->initial_.x[s_.id[i]][k];
  });
  clamps_.follow(s_, ahead_, places_);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::show(int group) {
  Strained now;
  Pack energy;
  std::visit(
      [&](const auto& bonds) {
        strain<true>(bonds, group, now);
        energy = now.energy + energy_of_four(bonds, group, now.F);
      },
      bonds_);
  for (int i = lanes * group, lane = 0; lane < lanes && i < s_.size(); ++i, ++lane)
    this->snapshot_.strain_energy[s_.id[i]] =
        energy[lane] + interfaces_.energy_of_kink(i, s_.x, law_of_one());
  // bonds of a particle that is held, or at a tip where they hardly span the space, give it no F
  const PackIndex has_own = sites(group).V > 0;
  for (int k = 0; k < Dim; ++k) now.F(k, k) = has_own ? now.F(k, k) : filled<Pack>(1);
  Mat<Pack, Dim> F = recovered_deformations(recovered_, displacements_, lanes * group, now.F);
  if constexpr (Dim == 3)
    keep_volume(recovered_, lanes * group, F, has_own ? determinant(now.F) : determinant(F));
  show_stress(group, F);
}

}  // namespace taut::inline TAUT_ISA
