#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/core/shared_rows.hpp"
#include "engine/families/bonded/bond_sums.hpp"
#include "engine/families/bonded/closed_law.hpp"
#include "engine/families/bonded/interface_sites.hpp"
#include "engine/families/bonded/layout_stiffness.hpp"
#include "engine/families/bonded/recovered_gradient.hpp"
#include "engine/families/bonded/setup.hpp"
#include "engine/families/bonded/shown_stress.hpp"
#include "engine/solver/particle_solver.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

/// Bodies held together by bonds (THEORY.md), which touch by a contact law. Time integration is position Verlet.
///
/// Two passes a step over groups of four particles, one a lane. The stress pass visits x_j and v_j; it computes F_i, the
/// bond forces and Q_i = T_i B_i. With g_ij = B_i a_ij and a_ij = −a_ji the stress force is
///   Σ_j (T_i g_ij − T_j g_ji) = Σ_j (Q_i + Q_j) a_ij,
/// which the force pass computes from Q. So the passes share one vector a bond.
template <const Formulation& M, int Dim>
class Bonded final : public ParticleSolver<Bonded<M, Dim>, Dim> {
 public:
  explicit Bonded(const SolverInput& input) : Bonded(input, make_bonded_setup(input)) {}

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
  using Base::c_, Base::s_, Base::contact_, Base::drives_, Base::initial_, Base::threads_now, Base::vmax_;
  using typename Base::V;

  struct GroupLaw {  // of four particles
    Pack V;          // m^Dim, weights the energy; 0 of the filling and of particles without F
    ClosedNeoHookean<Pack> law;
  };
  using GradientMoment = Mat<Pack, Dim>;
  struct GroupRows {  // indices of the group's constants
    int law, B;
  };
  struct StrainOfFour {
    Mat<Pack, Dim> F;      // 0 where V is 0
    Vec<Pack, Dim> force;  // of the bonds, N
    Pack energy;           // of the bonds, J; if requested
    Pack stiffest;         // greatest stiffness of bonds and particles, over the stiffness at rest
    Pack root;             // J^(−1/3), if the law is the own one
  };

  // off-lattice in 3D each particle has constants of its own, stored in half the bytes
  using AnyBonds = std::conditional_t<Dim == 2, std::variant<StoredBonds<Dim, StoredPack>>,
                                      std::variant<StoredBonds<Dim, StoredPack>, StoredBonds<Dim, HalfPack>>>;

  Bonded(const SolverInput& input, const BondedSetup& setup);
  AnyBonds stored(const BondedSetup& setup) const;
  void add_group_constants(const Bonds& bonds);
  void make_columns(const BondedSetup& setup);
  void find_layout_frequency();
  void half_drift(double dt);
  void stress_pass();
  template <class Storage>
  Vec<Pack, Dim> force(const StoredBonds<Dim, Storage>& bonds, int group) const;
  double force_pass(double dt);
  template <bool WithEnergy, class Storage>
  void strain(const StoredBonds<Dim, Storage>& bonds, int group, StrainOfFour& out) const;
  template <class Storage>
  void set_stress(const StoredBonds<Dim, Storage>& bonds, int group, const StrainOfFour& now);
  [[gnu::noinline]] Mat<Pack, Dim> piola_of_chosen_law(int group, const Mat<Pack, Dim>& F) const;
  template <class Storage>
  Pack energy_of_four(const StoredBonds<Dim, Storage>& bonds, int group, const Mat<Pack, Dim>& F) const;
  void show_stress(int group, const Mat<Pack, Dim>& F);
  [[gnu::noinline]] void pull_at_clamps();
  LawOfOne<M> law_of_one() const { return {materials_, own_law_, laws_}; }
  const GroupLaw& law(int group) const { return group_laws_[groups_[group].law]; }
  const GradientMoment& B(int group) const { return B_[groups_[group].B]; }
  void set_place(int i) { set_place(i, s_.x[i]); }
  void set_place(int i, const V& x) {
    const V v = s_.v[i];
    for (int k = 0; k < Dim; ++k) places_[k][i] = x[k], places_[Dim + k][i] = x[k] + lead_ * v[k];
  }
  static constexpr int block = 8;  // groups
  int block_count() const { return (group_count() + block - 1) / block; }
  int group_count() const { return (s_.size() + lanes - 1) / lanes; }

  std::vector<Elasticity> materials_;
  bool own_law_;  // the law in GroupLaw
  ChosenLaws<M> laws_;
  std::vector<int> material_;  // [stored], with the filling of the last group
  Constraints constraints_;    // [id]
  Pack least_r2_;              // m²: a bond is never shorter than a hundredth of a spacing
  double wave_speed_;          // m/s, see BondedSetup
  double lead_;                // s, damping lead, see BondedSetup
  double layout_ = 1;          // ω² of the highest mode at the start over ω² of a lattice, at least 1
  double stiffest_ = 1;  // greatest stiffness of bonds and particles in the last step, over the one at rest
  SharedRows<GroupLaw> group_laws_;
  SharedRows<GradientMoment> B_;
  std::vector<GroupRows> groups_;
  AnyBonds bonds_;
  InterfaceSites<Dim> interfaces_;
  Clamps<Dim> clamps_;
  Columns<2 * Dim> places_;                 // x, x + 3 τ v
  Columns<Dim * Dim> Q_;                    // row by row
  Columns<1> mobility_;                     // 1/m, or 0 of constrained particles, 1/kg
  std::vector<Vec<Pack, Dim>> bond_force_;  // [group] N
  RecoveredGradient recovered_;             // made for the first snapshot
  long released_ = 0;                       // particles whose drive has ended, in recovered_
  std::vector<StoredPack> displacements_;   // of the last snapshot, m; unused lanes are 0
};

template <const Formulation& M, int Dim>
Bonded<M, Dim>::Bonded(const SolverInput& input, const BondedSetup& setup)
    : Base(input, greatest_bond_reach * input.constants.h),
      materials_(input.materials),
      own_law_(input.law == M.law),
      laws_(input.law, input.materials),
      constraints_(setup.bonds.constraints),
      least_r2_(filled<Pack>(1e-4 * c_.dp * c_.dp)),
      wave_speed_(setup.wave_speed),
      lead_(setup.damping_lead),
      bonds_(stored(setup)),
      interfaces_(setup, s_.id) {
  this->lawful_stretch_ = std::sqrt(cancelled_range<Dim>[1]);
  this->pairs_ = static_cast<long>(setup.bonds.j.size());
  for (int i = 0; i < s_.size(); ++i) {
    s_.m[i] = setup.mass[s_.id[i]];
    material_.push_back(initial_.material[s_.id[i]]);
  }
  material_.resize(lanes * group_count());
  if (Dim == 3) this->loads_.spread_by(setup.bonds.mass, input.scene, initial_);
  add_group_constants(setup.bonds);
  Base::go_to_start();
  make_columns(setup);
  // in 3D a lattice three particles across, or four near incompressibility, has modes faster than the solid's
  if (setup.bonds.off_lattice || Dim == 3) find_layout_frequency();
  // columns: at a corner no choice of bonds leaves a uniform stress without force
  if (has_loads(input.scene))
    this->loads_.act_on_faces(input.scene, with_rigid_held(initial_, setup.bonds), FaceRule::by_column,
                              surface(setup.bonds), this->support_);
  contact_.search(s_);
  Base::show_contacts_to_probes();
  Base::record();
}

template <const Formulation& M, int Dim>
auto Bonded<M, Dim>::stored(const BondedSetup& setup) const -> AnyBonds {
  const auto with = [&]<class Storage>(Storage) -> AnyBonds {
    return StoredBonds<Dim, Storage>{PackedBonds<Dim, Storage>(setup, s_.id, this->threads_),
                                     CancelledBonds<Dim, Storage>(s_.size(), this->threads_, [&](int i) {
                                       return setup.cancelled_terms(s_.id[i]);
                                     })};
  };
  if constexpr (Dim == 3)
    if (setup.bonds.off_lattice) return with(HalfPack{});
  return with(StoredPack{});
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::add_group_constants(const Bonds& bonds) {
  struct Constants {
    std::vector<GroupLaw> laws{GroupLaw{}};
    std::vector<GradientMoment> B{GradientMoment{}};
  };
  const auto make = [&](int group) {
    Constants all;
    GroupLaw& four = all.laws[0];
    GradientMoment& B = all.B[0];
    for (int lane = 0; lane < lanes && lanes * group + lane < s_.size(); ++lane) {
      const int id = s_.id[lanes * group + lane];
      const Elasticity& material = materials_[initial_.material[id]];
      four.law.K[lane] = material.K, four.law.G[lane] = material.G;
      for (int a = 0; a < Dim; ++a)
        for (int k = 0; k < Dim; ++k) B(k, a)[lane] = bonds.B[id][a][k];
      if (B(0, 0)[lane] > 0) four.V[lane] = bonds.volume[id];
    }
    return all;
  };
  make_in_order(group_count(), this->threads_, make, [&](int, const Constants& all) {
    groups_.push_back({group_laws_.add(all.laws), B_.add(all.B)});
  });
  group_laws_.close(), B_.close();
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::make_columns(const BondedSetup& setup) {
  clamps_.add_places(setup.clamp_places, s_, drives_, places_, Q_);
  mobility_.resize(s_.size());
  for (int i = 0; i < s_.size(); ++i) set_place(i), mobility_[0][i] = s_.mobile[i] / s_.m[i];
  bond_force_.resize(group_count());
}

/// Time step, in s (THEORY.md, Stability limit): shorter once stiffened bonds and particles, and the layout, use up most
/// of the margin that a `cfl` of 0.64 leaves to the limit of 0.97.
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::step_size() const {
  constexpr double spare = 1.5;
  const double stiffer = std::sqrt(std::max(1.0, layout_ * stiffest_ / spare));
  return Base::fixed_or(c_.cfl * c_.dp / (wave_speed_ + vmax_) / stiffer);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::find_layout_frequency() {
  constexpr double small = 1e-5, limit = 0.97;  // spacings; cfl at the limit of a lattice
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
  const double square = highest_frequency_squared<Dim>(mobility, small * c_.dp, threads, forces),
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
  if (clamps_.has_driven() || this->reactions_.active()) pull_at_clamps();
  Base::set_greatest_speed(force_pass(dt));
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) { s_.x[i] += (0.5 * dt) * change; });
  Base::finish_step(dt);
}
inline constexpr TermInfo bonded_time_info{
    "time", "position Verlet, one step", "[Zhang2024] Eq. 22–25", "families/bonded/solver.hpp:step",
    "oenog: 40 steps are those of the formulas, with a clamp, two materials and on a ring"};

/// Advances x by half a step, also in the columns.
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
      store(x[k] + lead_ * v[k], places_[Dim + k] + first);
    }
  });
  clamps_.follow(s_, lead_, places_);
}

template <const Formulation& M, int Dim>
template <bool WithEnergy, class Storage>
void Bonded<M, Dim>::strain(const StoredBonds<Dim, Storage>& bonds, int group, StrainOfFour& out) const {
  const BondSums<Dim> sums = bond_sums<WithEnergy>(bonds.packed, places_, group, least_r2_);
  const Mat<Pack, Dim> F = product_transposed(sums.A, B(group));
  for (int a = 0; a < Dim; ++a) {
    out.force[a] = sums.force[a];
    for (int k = 0; k < Dim; ++k) out.F(a, k) = F(a, k);
  }
  if constexpr (WithEnergy) out.energy = sums.energy;
  const Pack closing = law(group).V > 0 ? closing_stiffness(determinant(F)) : Pack{};
  out.stiffest = max(Pack(sums.stiffest + bond_stiffness_offset), closing);
}

/// Returns V_i W(F_i) minus the cancellation of four particles, in J.
template <const Formulation& M, int Dim>
template <class Storage>
Pack Bonded<M, Dim>::energy_of_four(const StoredBonds<Dim, Storage>& bonds, int group,
                                    const Mat<Pack, Dim>& F) const {
  const GroupLaw& own = law(group);
  Sym<Pack, Dim> C = right_cauchy_green(F);
  for (int k = 0; k < Dim; ++k) C(k, k) = own.V > 0 ? C(k, k) : filled<Pack>(1);
  const Pack W = own_law_ ? own.law.energy(F) : laws_.visit([&](const auto& laws) {
    return closed_energy(laws, &material_[lanes * group], F);
  });
  return own.V * W - bonds.cancelled.energy(group, C);
}

template <const Formulation& M, int Dim>
Mat<Pack, Dim> Bonded<M, Dim>::piola_of_chosen_law(int group, const Mat<Pack, Dim>& F) const {
  return laws_.visit([&](const auto& laws) { return closed_piola(laws, &material_[lanes * group], F); });
}

/// Stores Q = T B.
template <const Formulation& M, int Dim>
template <class Storage>
void Bonded<M, Dim>::set_stress(const StoredBonds<Dim, Storage>& bonds, int group, const StrainOfFour& now) {
  const GroupLaw& own = law(group);
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

/// Works block by block: the long dependency chains of a root and a law overlap with those of other groups only if no
/// bond loops lie between them.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::stress_pass() {
  const auto pass = [&](const auto& bonds) {
    return parallel_max(block_count(), threads_now(), [&](int n) {
      const int first = block * n, count = std::min(block, group_count() - first);
      StrainOfFour of[block];
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

/// Returns the bond forces plus Σ_j (Q_i + Q_j) a_ij on four particles, in N.
template <const Formulation& M, int Dim>
template <class Storage>
Vec<Pack, Dim> Bonded<M, Dim>::force(const StoredBonds<Dim, Storage>& bonds, int group) const {
  Vec<Pack, Dim> f = bond_force_[group];
  add_stress_force(bonds.packed, Q_, group, f);
  return f;
}

/// Advances v by all forces and x by the second half step. Returns the greatest v², in m²/s².
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

/// Adds the reactions of bonds into clamps to the rigid particles: for the work of drives and for reaction probes.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::pull_at_clamps() {
  const auto pull_at = [&](int i, const V& pull) {
    for (int k = 0; k < Dim; ++k) bond_force_[i / lanes][k][i % lanes] -= pull[k];
  };
  std::visit(
      [&](const auto& bonds) { clamps_.for_each_pull(bonds.packed, places_, Q_, least_r2_[0], pull_at); },
      bonds_);
}

/// Stores the stress of F; rigid particles have none.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::show_stress(int group, const Mat<Pack, Dim>& F) {
  const int first = group * lanes, count = std::min(lanes, s_.size() - first);
  const auto four = shown_neo_hookean(law(group).law.K, law(group).law.G, F);
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
  std::vector<int> drive = initial_.drive;  // −1 once the drive has ended
  long released = 0;
  for (std::size_t id = 0; id < drive.size(); ++id)
    if (drive[id] >= 0 && !drives_.moves(static_cast<int>(id))) drive[id] = -1, ++released;
  if (released != released_) recovered_ = {};
  released_ = released;
  if (recovered_.empty())
    recovered_ =
        recovered_gradient(initial_, constraints_, drive, s_.id, c_.dp, this->support_, this->threads_,
                           /*halved*/ bonds_.index() > 0);
  this->snapshot_.strain_energy.resize(s_.size());
  displacements_.resize(s_.size());
  parallel_for(s_.size(), threads_now(), [&](int i) {
    set_place(i);
    for (int k = 0; k < Dim; ++k) displacements_[i].value[k] = s_.x[i][k] - initial_.x[s_.id[i]][k];
  });
  clamps_.follow(s_, lead_, places_);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::show(int group) {
  StrainOfFour now;
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
  // rigid particles, and tips whose bonds hardly span the space, have no F of their own
  const PackIndex has_own = law(group).V > 0;
  for (int k = 0; k < Dim; ++k) now.F(k, k) = has_own ? now.F(k, k) : filled<Pack>(1);
  // in 3D the volume is that of the own F: near incompressibility the recovered one, which no force keeps, is off
  Mat<Pack, Dim> F = recovered_deformations(recovered_, displacements_, lanes * group, now.F);
  if constexpr (Dim == 3)
    keep_volume(recovered_, lanes * group, F, has_own ? determinant(now.F) : determinant(F));
  show_stress(group, F);
}

}  // namespace taut::inline TAUT_ISA
