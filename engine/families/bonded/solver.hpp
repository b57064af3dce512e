#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "engine/families/bonded/bonds.hpp"
#include "engine/families/bonded/cancelled.hpp"
#include "engine/families/bonded/closed_law.hpp"
#include "engine/families/bonded/recovered_gradient.hpp"
#include "engine/core/shared_rows.hpp"
#include "engine/families/bonded/shown_stress.hpp"
#include "engine/solver/particle_solver.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

/// Bodies held together by bonds (terms/bond.hpp), which touch by a contact law. Position Verlet, so that
/// without damping the energy has no drift.
///
/// Three passes a step. The strain pass visits x_j and v_j and gives F_i and the bonds' force; the stress
/// pass takes four particles at once and no neighbour, cancels their bonds and gives Q_i = T_i B_i, from which
/// the force pass makes that of all stresses: with g_ij = B_i a_ij and a_ij = −a_ji it is
///   Σ_j (T_i g_ij − T_j g_ji) = Σ_j (Q_i + Q_j) a_ij,
/// so that the passes over neighbours share one vector a bond, and each visits one short row a neighbour.
/// F goes from the first to the second through memory: in one loop the bonds of the next particles do not
/// fill the time that the law's long chain of operations takes.
template <const Formulation& M, int Dim>
class Bonded final : public ParticleSolver<Bonded<M, Dim>, Dim> {
 public:
  explicit Bonded(const SolverInput& input)
      : Base(input, greatest_bond_reach * input.constants.h),
        materials_(input.materials),
        own_law_(input.law == M.law),
        laws_(input.law, input.materials),
        least_r2_(filled<Pack>(1e-4 * c_.dp * c_.dp)) {
    double shear_speed = 0;
    for (const int used : this->initial_.material) {
      wave_speed_ = std::max(wave_speed_, compression_wave_speed(materials_[used]));
      shear_speed = std::max(shear_speed, std::sqrt(materials_[used].G / materials_[used].rho0));
    }
    relaxation_ = c_.damping * c_.dp / shear_speed;
    CellGrid<Dim> grid;
    s_.reorder(grid.sort(s_.x, this->support_), threads_now());
    const Bonds bonds = make_bonds(input.scene, this->initial_, c_.h, input.threads);
    take_masses(bonds);
    Base::go_to_start();
    pack_bonds(bonds, input.scene);
    for (const int id : s_.id) material_.push_back(this->initial_.material[id]);
    material_.resize(lanes * groups());
    // not what a corner takes from a uniform stress, since there the bonds have no choice that is right
    this->loads_.act_on_faces(input.scene, this->initial_, FaceRule::by_column, surface(bonds),
                              this->support_);
    contact_.search(s_);
    Base::show_contacts_to_probes();
    Base::record();
  }

  void step();
  template <class Archive>
  void serialize(Archive& archive) {
    Base::serialize(archive);
    archive(stiffest_);
  }

 private:
  using Base = ParticleSolver<Bonded<M, Dim>, Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::threads_now, Base::vmax_;
  using typename Base::V;

  using PlaceRow = Row<2 * Dim>;     // x, v
  using StressRow = Row<Dim * Dim>;  // Q, row by row
  struct Spring {                    // four bonds; the filling has k = 0
    Pack k;                          // G (V0_i w_ij + V0_j w_ji)/r0², N/m (per metre depth in 2D)
    Pack per_r0_squared;             // 1/r0², 1/m²
  };
  struct BondsOf {  // one particle, in packs as in Neighbors
    int j, packs;   // first of all and their number
    int spring, scale;
    int a, a_packs;  // those with an a_ij are the first
  };
  struct Sites {  // four particles; the filling and what is held has V = 0
    Sym<Pack, Dim> B;
    Pack V;  // m^Dim, with which the energy counts
    ClosedNeoHookean<Pack> law;
  };
  struct Strained {    // of one particle, to be summed over the lanes
    Mat<Pack, Dim> A;  // (x_j − x_i) ⊗ a_ij: F = A B
    Vec<Pack, Dim> f;  // of the bonds, N
    Pack energy;       // of the bonds, J
    Pack stiffest;     // φ″ of a bond
  };

  void pack_bonds(const Bonds& bonds, const Scene& scene);
  PlaceRow place_at_clamp(const Scene& scene, int id, const Point& X) const;
  CancelledBonds<Dim> cancelled(const Bonds& bonds) const;
  void add_site(const Bonds& bonds, int i);
  void take_masses(const Bonds& bonds);
  double shear_modulus(const Bonds& bonds, int id, int b) const;
  double step_size() const;
  void strain_pass();
  void stress_pass();
  template <class Piola>
  void stress_pass_with(const Piola& piola);
  double force_pass(double dt);
  template <bool WithEnergy>
  Strained strained(int i) const;
  Pack energy_of_four(int group) const;
  template <bool WithEnergy>
  double strain(int group);
  Mat<Pack, Dim> shown_deformations(int group) const;
  static void keep_volume(Mat<Pack, Dim>& F, const Mat<Pack, Dim>& own) {
    const Pack least = filled<Pack>(0.05);  // what is crushed or inside out has none to keep
    const Pack ratio = max(determinant(own), least) / max(determinant(F), least);
    const Pack root = inverse_cube_root(ratio);
    F = (ratio * root * root) * F;
  }
  void show(int group, const Mat<Pack, Dim>& F);
  void take_snapshot() override;
  void set_row(int i) {
    const V x = s_.x[i], v = s_.v[i];
    for (int k = 0; k < Dim; ++k) places_[i].c[k] = x[k], places_[i].c[Dim + k] = v[k];
  }
  int groups() const { return (s_.size() + lanes - 1) / lanes; }

  std::vector<Elasticity> materials_;
  bool own_law_;  // that of Sites
  ChosenLaws<M> laws_;
  std::vector<int> material_;  // with the filling of the last group
  Pack least_r2_;              // m²: bonds shorter than a hundredth of a spacing are taken for that long
  double wave_speed_ = 0;      // m/s, of compression in the stiffest material
  double relaxation_ = 0;      // s, of the bonds
  double stiffest_ = 1;        // greatest of all bonds and particles in the last step, over that at rest
  std::vector<Sites> sites_;
  std::vector<BondsOf> bonds_;
  std::vector<int> j_;               // from size() on places at a clamp
  SharedRows<Vec<Pack, Dim>> a_ij_;  // times a constant that B takes out again
  SharedRows<Spring> springs_;
  SharedRows<StoredPack> energy_scales_;  // as far as a bond is an energy of this end: G V0_i w_ij, J
  CancelledBonds<Dim> cancelled_;
  std::vector<Mat<Pack, Dim>> F_;  // of each group; 0 where there is no volume
  std::vector<PlaceRow> places_;
  std::vector<StressRow> stress_;
  std::vector<V> bond_force_;     // N, with the filling of the last group
  RecoveredGradient recovered_;   // once a snapshot has asked for it
  std::vector<V> displacements_;  // of the last snapshot, m
};

/// In 2D a particle is as heavy as its cell; in 3D see bonds.hpp.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::take_masses(const Bonds& bonds) {
  if (Dim == 2) return;
  for (int i = 0; i < s_.size(); ++i)
    if (const int id = s_.id[i]; !this->initial_.held[id]) s_.m[i] *= bonds.mass[id] / this->initial_.V0[id];
}

/// G of a bond, Pa. Halves of two materials stand one behind the other in it, as two springs do: the harmonic
/// mean. What is held is as stiff as who holds on to it.
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::shear_modulus(const Bonds& bonds, int id, int b) const {
  const std::vector<int>& material = this->initial_.material;
  const int other = this->initial_.held[bonds.j[b]] ? id : bonds.j[b];
  const double G_i = materials_[material[id]].G, G_j = materials_[material[other]].G;
  return 2 * G_i * G_j / (G_i + G_j);
}

/// The row of the place that the bond X of a particle leads to.
template <const Formulation& M, int Dim>
auto Bonded<M, Dim>::place_at_clamp(const Scene& scene, int id, const Point& X) const -> PlaceRow {
  Point x = this->initial_.x[id];
  for (int k = 0; k < Dim; ++k) x[k] += X[k];
  x = displaced(scene.bodies[this->initial_.body[id]], x);
  PlaceRow row;
  for (int k = 0; k < Dim; ++k) row.c[k] = x[k];
  return row;
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::pack_bonds(const Bonds& bonds, const Scene& scene) {
  const InitialParticles& initial = this->initial_;
  const int n = s_.size();
  std::vector<int> where(n);
  for (int i = 0; i < n; ++i) where[s_.id[i]] = i;
  const auto seen_from = [&](int id, int other) {
    const int* last = bonds.j.data() + bonds.begin[id + 1];
    const int* found = std::find(bonds.j.data() + bonds.begin[id], last, other);
    return found == last ? -1 : static_cast<int>(found - bonds.j.data());
  };
  places_.resize(n);
  sites_.resize(groups());
  std::vector<int> order;  // of the bonds of a particle
  std::vector<Vec<Pack, Dim>> areas;
  std::vector<Spring> springs;
  std::vector<StoredPack> scales;
  for (int i = 0; i < n; ++i) {
    const int id = s_.id[i], count = bonds.begin[id + 1] - bonds.begin[id];
    set_row(i);
    add_site(bonds, i);
    order.resize(count);
    std::iota(order.begin(), order.end(), bonds.begin[id]);
    const auto rest =
        std::stable_partition(order.begin(), order.end(), [&](int b) { return bonds.area[b] != Point{}; });
    const int packs = (count + lanes - 1) / lanes;
    const int a_packs = (static_cast<int>(rest - order.begin()) + lanes - 1) / lanes;
    areas.assign(a_packs, Vec<Pack, Dim>{});
    springs.assign(packs, Spring{{}, 1 / least_r2_});  // the filling: λ = 1
    scales.assign(packs, StoredPack{});
    const int first_j = static_cast<int>(j_.size());
    for (int k = 0; k < count; ++k) {
      const int b = order[k], pack = k / lanes, lane = k % lanes;
      const int back = seen_from(bonds.j[b], id);
      j_.push_back(back >= 0 ? where[bonds.j[b]] : static_cast<int>(places_.size()));
      if (back < 0) places_.push_back(place_at_clamp(scene, id, bonds.X[b]));
      double r2 = 0;
      for (int d = 0; d < Dim; ++d) {
        r2 += bonds.X[b][d] * bonds.X[b][d];
        if (pack < a_packs) areas[pack][d][lane] = bonds.area[b][d];
      }
      // a place at a clamp has no energy of its own
      const double G = shear_modulus(bonds, id, b), of_other = back < 0 ? 0 : bonds.weight[back];
      scales[pack].value[lane] = G * initial.V0[id] * bonds.weight[b];
      springs[pack].k[lane] = (scales[pack].value[lane] + G * initial.V0[bonds.j[b]] * of_other) / r2;
      springs[pack].per_r0_squared[lane] = 1 / r2;
    }
    j_.resize(first_j + static_cast<std::size_t>(lanes) * packs, i);
    bonds_.push_back(
        {first_j, packs, springs_.add(springs), energy_scales_.add(scales), a_ij_.add(areas), a_packs});
  }
  a_ij_.close(), springs_.close(), energy_scales_.close();
  cancelled_ = cancelled(bonds);
  stress_.resize(std::max<std::size_t>(places_.size(), lanes * groups()));  // past the end: of the filling
  F_.resize(groups());
  bond_force_.resize(lanes * groups());
  this->pairs_ = static_cast<long>(bonds.j.size());
}

template <const Formulation& M, int Dim>
CancelledBonds<Dim> Bonded<M, Dim>::cancelled(const Bonds& bonds) const {
  std::vector<std::vector<typename CancelledBonds<Dim>::Bond>> of_particle(s_.size());
  for (int i = 0; i < s_.size(); ++i) {
    const int id = s_.id[i];
    for (int b = bonds.begin[id]; b < bonds.begin[id + 1]; ++b) {
      const Point& X = bonds.X[b];
      double r2 = 0;
      for (int k = 0; k < Dim; ++k) r2 += X[k] * X[k];
      Sym<double, Dim> dyad;
      for (int a = 0; a < Dim; ++a)
        for (int k = a; k < Dim; ++k) dyad(a, k) = X[a] * X[k] / r2;
      of_particle[i].push_back({dyad, shear_modulus(bonds, id, b) * this->initial_.V0[id] * bonds.weight[b]});
    }
  }
  return CancelledBonds<Dim>(of_particle);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::add_site(const Bonds& bonds, int i) {
  Sites& four = sites_[i / lanes];
  const int lane = i % lanes, id = s_.id[i];
  const Elasticity& material = materials_[this->initial_.material[id]];
  four.law.K[lane] = material.K, four.law.G[lane] = material.G;
  for (int a = 0; a < Dim; ++a)
    for (int k = a; k < Dim; ++k) four.B(a, k)[lane] = bonds.B[id][a][k];
  if (four.B(0, 0)[lane] > 0) four.V[lane] = bonds.volume[id];
}

/// s. [Zhang2024] Eq. 22 with the speed of compression waves, for any ν, and with dp, on which the limit
/// depends and not on h. A bond that is pressed or pulled gets stiffer, and so does a particle whose J is
/// below one half; steps get shorter once that takes up most of what a `cfl` of 0.64 leaves to the limit of
/// 0.97.
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::step_size() const {
  constexpr double spare = 1.5;
  const double stiffer = std::sqrt(std::max(1.0, stiffest_ / spare));
  return Base::fixed_or(c_.cfl * c_.dp / (wave_speed_ + vmax_) / stiffer);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::step() {
  const double dt = step_size();
  if (contact_.prepare(s_, vmax_ * dt)) Base::show_contacts_to_probes();
  parallel_for(s_.size(), threads_now(), [&](int i) {
    s_.x[i] += (0.5 * dt) * s_.v[i];
    set_row(i);
  });
  contact_.evaluate(s_, dt);
  strain_pass();
  stress_pass();
  Base::set_greatest_speed(force_pass(dt));
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) { s_.x[i] += (0.5 * dt) * change; });
  Base::finish_step(dt);
}
inline constexpr TermInfo bonded_time_info{
    "time", "position Verlet, one step", "[Zhang2024] Eq. 22–25", "families/bonded/solver.hpp:step",
    "oenog: 40 steps are those of the formulas, with a clamp, two materials and on a ring"};

/// Σ_j (x_j − x_i) ⊗ a_ij, and of the bonds the force Σ_j k (φ′(λ)/λ + τ q̇) (x_j − x_i) and, if asked for,
/// the energy.
template <const Formulation& M, int Dim>
template <bool WithEnergy>
auto Bonded<M, Dim>::strained(int i) const -> Strained {
  constexpr int width = PlaceRow::width;
  const Vec<Pack, Dim> x_i = spread(s_.x[i]), v_i = spread(s_.v[i]);
  Mat<Pack, Dim> A{};
  Vec<Pack, Dim> f{};
  Pack energy{}, stiffest{};
  const BondsOf& own = bonds_[i];
  const Spring* springs = &springs_[own.spring];
  const auto add_bond = [&](int b) {  // gives x_j − x_i
    Pack row[width];                  // x_j, v_j
    gather<width>(places_[0].c, &j_[own.j + lanes * b], row);
    Vec<Pack, Dim> d, w;
    for (int k = 0; k < Dim; ++k) d[k] = row[k] - x_i[k], w[k] = row[Dim + k] - v_i[k];
    const Spring& spring = springs[b];
    const Pack s = max(dot(d, d), least_r2_) * spring.per_r0_squared;
    const Pack rate = dot(d, w) * spring.per_r0_squared;  // q̇
    stiffest = max(stiffest, bond_stiffness(s));
    f += Pack(spring.k * (bond_slope(s) + relaxation_ * rate)) * d;
    if constexpr (WithEnergy) energy += energy_scales_[own.scale + b].value * bond_energy(s);
    return d;
  };
  for (int b = 0; b < own.a_packs; ++b) add_outer(A, filled<Pack>(1), add_bond(b), a_ij_[own.a + b]);
  for (int b = own.a_packs; b < own.packs; ++b) add_bond(b);
  return {A, f, energy, stiffest};
}
inline constexpr TermInfo bonded_damping_info{
    "damping", "f_i = Σ_j k_ij τ q̇_ij (x_j − x_i), q = ½ (λ² − 1), τ = damping dp √(ρ0/G)", "ours",
    "families/bonded/solver.hpp:strained",
    "oenog: the damping takes a zigzag away and leaves the first mode alone"};

/// V_i W(F_i) less what is cancelled of the bonds, of four particles, J
template <const Formulation& M, int Dim>
Pack Bonded<M, Dim>::energy_of_four(int group) const {
  const Sites& sites = sites_[group];
  Sym<Pack, Dim> C = right_cauchy_green(F_[group]);
  for (int k = 0; k < Dim; ++k) C(k, k) = sites.V > 0 ? C(k, k) : filled<Pack>(1);
  const Pack W = own_law_ ? sites.law.energy(F_[group]) : laws_.visit([&](const auto& laws) {
    return closed_energy(laws, &material_[lanes * group], F_[group]);
  });
  return sites.V * W - cancelled_.energy(group, C);
}

/// F and the bonds' force of four particles, or fewer in the last group, and their energy if asked for. The
/// greatest stiffness, over that of a bond at rest.
template <const Formulation& M, int Dim>
template <bool WithEnergy>
double Bonded<M, Dim>::strain(int group) {
  const int first = group * lanes, count = std::min(lanes, s_.size() - first);
  Strained of[lanes];
  for (int lane = 0; lane < lanes; ++lane)  // past the end: the last particle again
    of[lane] = strained<WithEnergy>(std::min(first + lane, s_.size() - 1));
  const auto sums_of = [&](const auto& entry) {
    return sums(entry(of[0]), entry(of[1]), entry(of[2]), entry(of[3]));
  };
  Mat<Pack, Dim> A;
  for (int a = 0; a < Dim; ++a) {
    for (int k = 0; k < Dim; ++k)
      A(a, k) = sums_of([&](const Strained& one) -> const Pack& { return one.A(a, k); });
    const Pack f = sums_of([&](const Strained& one) -> const Pack& { return one.f[a]; });
    for (int lane = 0; lane < lanes; ++lane) bond_force_[first + lane][a] = f[lane];
  }
  const Sites& sites = sites_[group];
  F_[group] = product(A, sites.B);
  if constexpr (WithEnergy) {
    std::vector<double>& energies = this->snapshot_.strain_energy;
    const Pack energy =
        sums_of([](const Strained& one) -> const Pack& { return one.energy; }) + energy_of_four(group);
    for (int lane = 0; lane < count; ++lane) energies[s_.id[first + lane]] = energy[lane];
  }
  Pack stiffest = max(max(of[0].stiffest, of[1].stiffest), max(of[2].stiffest, of[3].stiffest));
  stiffest = max(stiffest, sites.V > 0 ? closing_stiffness(determinant(F_[group])) : Pack{});
  return max(max(stiffest[0], stiffest[1]), max(stiffest[2], stiffest[3]));
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::strain_pass() {
  stiffest_ =
      parallel_max(groups(), threads_now(), [&](int group) TAUT_FLATTEN { return strain<false>(group); });
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::stress_pass() {
  if (own_law_) return stress_pass_with([&](int group) { return sites_[group].law.piola(F_[group]); });
  laws_.visit([&](const auto& laws) {
    stress_pass_with([&](int group) { return closed_piola(laws, &material_[lanes * group], F_[group]); });
  });
}

/// `piola`(group): P of four particles.
template <const Formulation& M, int Dim>
template <class Piola>
void Bonded<M, Dim>::stress_pass_with(const Piola& piola) {
  parallel_for(groups(), threads_now(), [&](int group) TAUT_FLATTEN {
    const Sites& sites = sites_[group];
    const Mat<Pack, Dim>& F = F_[group];
    Mat<Pack, Dim> T = sites.V * piola(group);
    const Mat<Pack, Dim> FS = product(F, cancelled_.slopes(group, right_cauchy_green(F)));
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) T(a, k) -= FS(a, k);
    const Mat<Pack, Dim> Q = product(T, sites.B);
    Pack columns[StressRow::width] = {};
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) columns[a * Dim + k] = Q(a, k);
    scatter<StressRow::width>(columns, stress_[lanes * group].c);
  });
}

/// f_i = that of the bonds + Σ_j (Q_i + Q_j) a_ij + contact; then v and the second half of x. The greatest
/// v², m²/s².
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::force_pass(double dt) {
  constexpr int width = StressRow::width;
  const typename Base::Kick kick(*this, dt, this->time_ + dt);
  return parallel_max(s_.size(), threads_now(), [&](int i) TAUT_FLATTEN {
    Pack Q_i[Dim * Dim];
    for (int k = 0; k < Dim * Dim; ++k) Q_i[k] = filled<Pack>(stress_[i].c[k]);
    Vec<Pack, Dim> f{};
    const BondsOf& own = bonds_[i];
    for (int b = 0; b < own.a_packs; ++b) {
      Pack Q_j[width];
      const Vec<Pack, Dim>& a_ij = a_ij_[own.a + b];
      gather<width>(stress_[0].c, &j_[own.j + lanes * b], Q_j);
      for (int a = 0; a < Dim; ++a)
        for (int k = 0; k < Dim; ++k) f[a] += (Q_i[a * Dim + k] + Q_j[a * Dim + k]) * a_ij[k];
    }
    V force = sum(f);
    force += bond_force_[i];
    const V v = kick.by_force(i, force);
    s_.x[i] += (0.5 * dt) * v;
    return dot(v, v);
  });
}

/// Four F with those of the recovered gradient, where there are any.
template <const Formulation& M, int Dim>
Mat<Pack, Dim> Bonded<M, Dim>::shown_deformations(int group) const {
  Mat<Pack, Dim> F = F_[group];
  const int first = group * lanes, count = std::min(lanes, s_.size() - first);
  for (int lane = 0; lane < count; ++lane) {
    const int i = first + lane, begin = recovered_.begin[i], end = recovered_.begin[i + 1];
    if (begin == end) continue;
    Mat<double, Dim> one{};
    for (int a = 0; a < Dim; ++a) one(a, a) = 1;
    for (int b = begin; b < end; ++b) {
      const V u = displacements_[recovered_.j[b]] - displacements_[i];
      for (int a = 0; a < Dim; ++a)
        for (int k = 0; k < Dim; ++k) one(a, k) += u[a] * recovered_.g[b][k];
    }
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) F(a, k)[lane] = one(a, k);
  }
  return F;
}

/// The stress shown is that of the recovered F; none of a held particle, which is rigid. In 3D F is scaled to the volume
/// of the method's own: near incompressibility the volume of the recovered one, which no force keeps, is off by more
/// than the one that the pressure comes from.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::show(int group, const Mat<Pack, Dim>& F) {
  const int first = group * lanes, count = std::min(lanes, s_.size() - first);
  const auto four = shown_neo_hookean(sites_[group].law.K, sites_[group].law.G, F);
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
void Bonded<M, Dim>::take_snapshot() {
  Base::begin_snapshot();
  if (recovered_.empty()) recovered_ = 
        recovered_gradient(this->initial_, s_.id, c_.dp, this->support_, threads_now());
  this->snapshot_.strain_energy.resize(s_.size());
  displacements_.resize(s_.size());
  parallel_for(s_.size(), threads_now(), [&](int i) {
    set_row(i);
    for (int k = 0; k < Dim; ++k) displacements_[i][k] = s_.x[i][k] - this->initial_.x[s_.id[i]][k];
  });
  parallel_for(groups(), threads_now(), [&](int group) TAUT_FLATTEN {
    strain<true>(group);
    const Sites& sites = sites_[group];
    Mat<Pack, Dim> F = shown_deformations(group);
    if constexpr (Dim == 3) keep_volume(F, F_[group]);
    for (int k = 0; k < Dim; ++k) F(k, k) = sites.V > 0 ? F(k, k) : filled<Pack>(1);
    show(group, F);
  });
}

}  // namespace taut::inline TAUT_ISA
