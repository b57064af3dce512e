#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/bonds.hpp"
#include "engine/solver/particle_solver.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

/// Bodies held together by bonds (terms/bond.hpp), which touch by a contact law. Position Verlet,
/// so that the energy has no drift; no dissipation.
///
/// Two passes a step. The first visits x_j and gives F_i, the bonds' force and Q_i = V_i P_i B_i, from which
/// the second makes the force of all volumes: with g_ij = B_i a_ij and a_ij = −a_ji it is
///   Σ_j (V_i P_i g_ij − V_j P_j g_ji) = Σ_j (Q_i + Q_j) a_ij,
/// so that both passes share one vector a bond, and each visits one short row a neighbour.
template <const Formulation& M, int Dim>
class Bonded final : public ParticleSolver<Dim> {
 public:
  explicit Bonded(const SolverInput& input)
      : Base(input, greatest_bond_reach * input.constants.h),
        materials_(input.materials),
        least_r2_(filled<Pack>(1e-4 * c_.dp * c_.dp)) {
    for (const int used : this->layout_.material)
      wave_speed_ = std::max(wave_speed_, compression_wave_speed(materials_[used]));
    CellGrid<Dim> grid;
    s_.reorder(grid.sort(s_.x, this->support_), threads_now());
    pack_bonds(make_bonds(input.scene, this->layout_, c_.h));
    contact_.search(s_);
    show_contacts_to_probes();
    Base::record_start();
    take_snapshot();
  }

  void advance_to(double t) override {
    Base::run_to(t, [this] { step(); });
    take_snapshot();
  }

  std::string save() override { return Base::saved(*this); }
  void load(std::string_view state) override {
    Base::load_into(*this, state);
    take_snapshot();
  }
  template <class Archive>
  void serialize(Archive& archive) {
    Base::serialize(archive);
    archive(most_t_);
  }

 private:
  using Base = ParticleSolver<Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::drives_, Base::threads_now, Base::vmax_;
  using typename Base::V;

  using PlaceRow = Row<Dim>;         // x
  using VolumeRow = Row<Dim * Dim>;  // Q, row by row
  struct Spring {                    // four bonds; the filling has k = 0
    Pack k;                          // G (V_i w_ij + V_j w_ji)/r0², N/m (per metre depth in 2D)
    Pack r0_squared;                 // m²
  };
  struct Site {
    Sym<double, Dim> B;
    double V;        // m^Dim, with which the energy counts
    Volumetric law;  // of the material
  };
  struct Strained {
    Mat<double, Dim> F;
    V force;        // of the bonds, N
    double energy;  // of the bonds, J
    double most_t;  // greatest 1/λ²
  };

  void pack_bonds(const Bonds& bonds);
  double spring(const Bonds& bonds, int id, int b, int back) const;
  void show_contacts_to_probes();
  void step();
  double step_size() const;
  void first_pass();
  double second_pass(double dt);
  template <bool WithEnergy>
  Strained strained(int i) const;
  void take_snapshot();
  void set_row(int i) {
    for (int k = 0; k < Dim; ++k) places_[i].c[k] = s_.x[i][k];
  }
  bool has_volume(int i) const { return sites_[i].B(0, 0) > 0; }

  std::vector<Elasticity> materials_;
  Pack least_r2_;          // m²: bonds shorter than a hundredth of a spacing are taken for that long
  double wave_speed_ = 0;  // m/s, of compression in the stiffest material
  double most_t_ = 1;      // greatest 1/λ² of all bonds in the last step
  std::vector<Site> sites_;
  std::vector<int> begin_, j_;        // bonds in packs, as in Neighbors; from size() on places at a clamp
  std::vector<Vec<Pack, Dim>> a_ij_;  // m^Dim/m, times a constant that B takes out again
  std::vector<Spring> springs_;
  std::vector<PlaceRow> places_;
  std::vector<VolumeRow> volumes_;
  std::vector<V> bond_force_;  // N
};

/// N/m: that of the energies of both ends. Halves of two materials stand one behind the other in a bond, as
/// two springs do: the harmonic mean of their G. A place at a clamp has no energy of its own.
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::spring(const Bonds& bonds, int id, int b, int back) const {
  const std::vector<int>& material = this->layout_.material;
  const int other = bonds.j[b];
  const double G_i = materials_[material[id]].G;
  const double G_j = back < 0 ? G_i : materials_[material[other]].G;
  double Vw = bonds.volume[id] * bonds.weight[b], r2 = 0;
  if (back >= 0) Vw += bonds.volume[other] * bonds.weight[back];
  for (int k = 0; k < Dim; ++k) r2 += bonds.X[b][k] * bonds.X[b][k];
  return 2 * G_i * G_j / (G_i + G_j) * Vw / r2;
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::pack_bonds(const Bonds& bonds) {
  const Layout& layout = this->layout_;
  const int n = s_.size();
  std::vector<int> where(n);
  for (int i = 0; i < n; ++i) where[s_.id[i]] = i;
  const auto seen_from = [&](int id, int other) {
    const int* last = bonds.j.data() + bonds.begin[id + 1];
    const int* found = std::find(bonds.j.data() + bonds.begin[id], last, other);
    return found == last ? -1 : static_cast<int>(found - bonds.j.data());
  };
  places_.resize(n);
  begin_.push_back(0);
  for (int i = 0; i < n; ++i) {
    const int id = s_.id[i], last = bonds.begin[id + 1];
    set_row(i);
    const Elasticity& material = materials_[layout.material[id]];
    sites_.push_back({{}, bonds.volume[id], Volumetric(material.K, material.G)});
    for (int a = 0; a < Dim; ++a)
      for (int k = a; k < Dim; ++k) sites_[i].B(a, k) = bonds.B[id][a][k];
    for (int first = bonds.begin[id]; first < last; first += lanes) {
      Vec<Pack, Dim> area{};
      Spring four{{}, least_r2_};  // the filling: t = 1
      for (int lane = 0; lane < lanes; ++lane) {
        const int b = first + lane;
        if (b >= last) {
          j_.push_back(i);
          continue;
        }
        const int back = seen_from(bonds.j[b], id);
        j_.push_back(back >= 0 ? where[bonds.j[b]] : static_cast<int>(places_.size()));
        if (back < 0) places_.emplace_back();
        four.k[lane] = spring(bonds, id, b, back);
        four.r0_squared[lane] = 0;
        for (int k = 0; k < Dim; ++k) {
          if (back < 0) places_.back().c[k] = layout.x[id][k] + bonds.X[b][k];
          four.r0_squared[lane] += bonds.X[b][k] * bonds.X[b][k];
          area[k][lane] = bonds.area[b][k];
        }
      }
      a_ij_.push_back(area);
      springs_.push_back(four);
    }
    begin_.push_back(static_cast<int>(springs_.size()));
  }
  volumes_.resize(places_.size());
  bond_force_.resize(n);
  this->pairs_ = static_cast<long>(bonds.j.size());
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::show_contacts_to_probes() {
  s_.neighbors = contact_.neighbors(s_.size());
  this->recorder_.rebuilt(s_, Contact<Dim>::reach * c_.dp);
}

/// s. [Zhang2024] Eq. 22 with the speed of compression waves, for any ν, and with dp, on which the limit
/// depends and not on h. A bond that is pressed gets stiffer, and the steps shorter, once it takes up what a
/// `cfl` of 0.64 leaves to the limit of 0.97.
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::step_size() const {
  constexpr double spare = 1.5;
  const double stiffer = std::sqrt(std::max(1.0, bond_stiffness(most_t_) / spare));
  return Base::fixed_or(c_.cfl * c_.dp / (wave_speed_ + vmax_) / stiffer);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::step() {
  const double dt = step_size();
  if (contact_.prepare(s_, vmax_ * dt)) show_contacts_to_probes();
  parallel_for(s_.size(), threads_now(), [&](int i) {
    s_.x[i] += (0.5 * dt) * s_.v[i];
    set_row(i);
  });
  contact_.evaluate(s_, dt);
  first_pass();
  Base::set_greatest_speed(second_pass(dt));
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) { s_.x[i] += (0.5 * dt) * change; });
  Base::finish_step(dt);
}

/// F_i = Σ_j (x_j − x_i) ⊗ g_ij, and of the bonds the force Σ_j k φ′(λ)/λ (x_j − x_i) and, if asked for, the
/// energy: half of each bond's, and all of one that ends at a clamp.
template <const Formulation& M, int Dim>
template <bool WithEnergy>
auto Bonded<M, Dim>::strained(int i) const -> Strained {
  constexpr int width = PlaceRow::width;
  V here;
  for (int k = 0; k < Dim; ++k) here[k] = places_[i].c[k];
  const Vec<Pack, Dim> x_i = spread(here);
  Mat<Pack, Dim> F{};
  Vec<Pack, Dim> f{};
  Pack energy{}, most_t{};
  for (int b = begin_[i]; b < begin_[i + 1]; ++b) {
    const int* j = &j_[static_cast<std::size_t>(lanes) * b];
    Pack x_j[width];
    gather<width>(places_[0].c, j, x_j);
    Vec<Pack, Dim> d;
    for (int k = 0; k < Dim; ++k) d[k] = x_j[k] - x_i[k];
    const Spring& spring = springs_[b];
    const Pack t = spring.r0_squared / max(dot(d, d), least_r2_);
    most_t = max(most_t, t);
    f += Pack(spring.k * bond_slope(t)) * d;
    add_outer(F, filled<Pack>(1), d, a_ij_[b]);
    if constexpr (WithEnergy) {
      Pack share;
      for (int lane = 0; lane < lanes; ++lane) share[lane] = j[lane] < s_.size() ? 0.5 : 1;
      energy += share * spring.k * spring.r0_squared * bond_energy(t);
    }
  }
  return {product(sum(F), sites_[i].B), sum(f), sum(energy),
          std::max(std::max(most_t[0], most_t[1]), std::max(most_t[2], most_t[3]))};
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::first_pass() {
  most_t_ = parallel_max(s_.size(), threads_now(), [&](int i) TAUT_FLATTEN {
    const auto [F, force, energy, most_t] = strained<false>(i);
    bond_force_[i] = force;
    if (!has_volume(i)) return most_t;
    const Site& site = sites_[i];
    const double pressure = site.V * site.law.slope(determinant(F));
    const Mat<double, Dim> Q = product(cofactor(F), site.B);
#pragma GCC unroll 3
    for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
      for (int k = 0; k < Dim; ++k) volumes_[i].c[a * Dim + k] = pressure * Q(a, k);
    return most_t;
  });
}

/// f_i = that of the bonds + Σ_j (Q_i + Q_j) a_ij + contact; then v and the second half of x. The greatest
/// v², m²/s².
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::second_pass(double dt) {
  constexpr int width = VolumeRow::width;
  Base::set_outside(dt, this->time_ + dt);
  const bool contact = contact_.active(), outside = Base::outside_acts();
  return parallel_max(s_.size(), threads_now(), [&](int i) TAUT_FLATTEN {
    Pack Q_i[Dim * Dim];
    for (int k = 0; k < Dim * Dim; ++k) Q_i[k] = filled<Pack>(volumes_[i].c[k]);
    Vec<Pack, Dim> f{};
    for (int b = begin_[i]; b < begin_[i + 1]; ++b) {
      Pack Q_j[width];
      gather<width>(volumes_[0].c, &j_[static_cast<std::size_t>(lanes) * b], Q_j);
      for (int a = 0; a < Dim; ++a)
        for (int k = 0; k < Dim; ++k) f[a] += (Q_i[a * Dim + k] + Q_j[a * Dim + k]) * a_ij_[b][k];
    }
    V force = sum(f);
    force += bond_force_[i];
    if (contact) force += contact_.force(i);
    V v = s_.v[i];
    v += (dt * s_.mobile[i] / s_.m[i]) * force;
    if (outside) Base::act_from_outside(i, dt, v);
    s_.v[i] = v;
    s_.x[i] += (0.5 * dt) * v;
    return dot(v, v);
  });
}

/// The stress shown is the neo-Hookean one of F: p = −K (J − 1), s = G J^(−5/3) dev(F Fᵀ) with (F Fᵀ)_zz = 1
/// in 2D; none of a held particle, which is rigid.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::take_snapshot() {
  Base::begin_snapshot();
  std::vector<double>& energies = this->snapshot_.strain_energy;
  energies.resize(s_.size());
  parallel_for(s_.size(), threads_now(), [&](int i) { set_row(i); });
  parallel_for(s_.size(), threads_now(), [&](int i) TAUT_FLATTEN {
    const Site& site = sites_[i];
    const Elasticity& material = materials_[this->layout_.material[s_.id[i]]];
    auto [F, force, energy, most_t] = strained<true>(i);
    if (!has_volume(i))
      for (int k = 0; k < Dim; ++k) F(k, k) = 1;
    const double J = determinant(F);
    Sym<double, Dim> b{};
    for (int a = 0; a < Dim; ++a)
      for (int k = a; k < Dim; ++k)
        for (int l = 0; l < Dim; ++l) b(a, k) += F(a, l) * F(k, l);
    const double mean = (trace(b) + (3 - Dim)) / 3, scale = material.G * std::pow(J, -5.0 / 3);
    for (int k = 0; k < Dim; ++k) b(k, k) -= mean;
    Base::store(i, material.rho0 / J, -material.K * (J - 1), scale * b, scale * (1 - mean));
    energies[s_.id[i]] = energy + site.V * site.law.energy(J);
  });
}

}  // namespace taut::inline TAUT_ISA
