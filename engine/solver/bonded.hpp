#pragma once

#include <vector>

#include "engine/bonds.hpp"
#include "engine/solver/particle_solver.hpp"
#include "engine/terms/bond.hpp"

namespace taut::inline TAUT_ISA {

/// Bodies held together by bonds (terms/bond.hpp), which touch by a contact law. Position Verlet,
/// so that the energy has no drift; no dissipation.
template <const Formulation& M, int Dim>
class Bonded final : public ParticleSolver<Dim> {
 public:
  explicit Bonded(const SolverInput& input)
      : Base(input, Kernel<M.kernel>::support * input.constants.h), volumetric_(c_.K, c_.G) {
    CellGrid<Dim> grid;
    s_.reorder(grid.sort(s_.x, this->support_), threads_now());
    rows_.resize(s_.size());
    F_.resize(s_.size());
    make_bond_packs(make_bonds(this->layout_, c_.h, this->support_));
    contact_.search(s_);
    show_contacts_to_probes();
    Base::record_start();
    take_snapshot();
  }

  void advance_to(double t) override {
    Base::run_to(t, [this] { step(); });
    take_snapshot();
  }

 private:
  using Base = ParticleSolver<Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::drives_, Base::threads_now, Base::vmax_;
  using typename Base::V;

  /// What the passes gather about a particle: x, then P row by row, each filled up to whole packs.
  static constexpr int place = (Dim + lanes - 1) / lanes * lanes;
  static constexpr int width = place + (Dim * Dim + lanes - 1) / lanes * lanes;
  struct alignas(64) BondRow {
    double c[width] = {};
  };
  /// Four bonds of a particle, as the force pass needs them; the filling is 0.
  struct BondPack {
    Vec<Pack, Dim> V_j_g_ji;  // m^Dim · 1/m
    Pack kappa;               // N, or N/m
    Pack inv_r0;              // 1/m
  };

  void make_bond_packs(const Bonds& bonds);
  void show_contacts_to_probes();
  void step();
  void deformation_pass();
  double force_pass(double dt);
  double strain_energy(int i) const;
  void set_rows();
  void take_snapshot();
  V stored_place(int i) const {
    V x;
    for (int k = 0; k < Dim; ++k) x[k] = rows_[i].c[k];
    return x;
  }

  Volumetric volumetric_;
  std::vector<BondRow> rows_;
  std::vector<Mat<double, Dim>> F_;
  std::vector<int> begin_, j_;        // bonds in packs, as in Neighbors
  std::vector<Vec<Pack, Dim>> g_ij_;  // 1/m
  std::vector<BondPack> bonds_;
  std::vector<V> sum_V_i_g_ij_;
};

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::make_bond_packs(const Bonds& bonds) {
  const Layout& layout = this->layout_;
  std::vector<int> where(s_.size());
  for (int i = 0; i < s_.size(); ++i) where[s_.id[i]] = i;
  const auto seen_from = [&](int id, int other) {
    return static_cast<int>(std::find(&bonds.j[bonds.begin[id]], &bonds.j[bonds.begin[id + 1]], other) -
                            bonds.j.data());
  };
  sum_V_i_g_ij_.assign(s_.size(), V{});
  begin_.push_back(0);
  for (int i = 0; i < s_.size(); ++i) {
    const int id = s_.id[i], last = bonds.begin[id + 1];
    for (int first = bonds.begin[id]; first < last; first += lanes) {
      Vec<Pack, Dim> g{};
      BondPack pack{};
      pack.inv_r0 = filled<Pack>(1 / c_.dp);
      for (int lane = 0; lane < lanes; ++lane) {
        const int b = first + lane;
        j_.push_back(b < last ? where[bonds.j[b]] : i);
        if (b >= last) continue;
        const int other = bonds.j[b], back = seen_from(other, id);
        pack.inv_r0[lane] = 1 / bonds.r0[b];
        pack.kappa[lane] =
            c_.G * (layout.V0[id] * bonds.weight[b] + layout.V0[other] * bonds.weight[back]) / bonds.r0[b];
        for (int k = 0; k < Dim; ++k) {
          g[k][lane] = bonds.gradient[b][k];
          pack.V_j_g_ji[k][lane] = layout.V0[other] * bonds.gradient[back][k];
          sum_V_i_g_ij_[i][k] += layout.V0[id] * bonds.gradient[b][k];
        }
      }
      g_ij_.push_back(g);
      bonds_.push_back(pack);
    }
    begin_.push_back(static_cast<int>(bonds_.size()));
  }
  this->pairs_ = static_cast<long>(bonds.j.size());
}

/// There are no other neighbours; those of a body never change.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::show_contacts_to_probes() {
  s_.neighbors = contact_.neighbors(s_.size());
  this->recorder_.rebuilt(s_, Contact<Dim>::reach * c_.dp);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::step() {
  const double dt = Base::step_size();
  if (contact_.prepare(s_, vmax_ * dt)) show_contacts_to_probes();
  parallel_for(s_.size(), threads_now(), [&](int i) { s_.x[i] += (0.5 * dt) * s_.v[i]; });
  contact_.evaluate(s_);
  set_rows();
  deformation_pass();
  Base::set_greatest_speed(force_pass(dt));
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) { s_.x[i] += (0.5 * dt) * change; });
  Base::finish_step(dt);
}

template <const Formulation& M, int Dim>
void Bonded<M, Dim>::set_rows() {
  parallel_for(s_.size(), threads_now(), [&](int i) {
    for (int k = 0; k < Dim; ++k) rows_[i].c[k] = s_.x[i][k];
  });
}

/// F_i = Σ_j (x_j − x_i) ⊗ g_ij and P_i = U′(J) cof F of every particle.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::deformation_pass() {
  parallel_for(s_.size(), threads_now(), [&](int i) {
    const Vec<Pack, Dim> x_i = spread(stored_place(i));
    Mat<Pack, Dim> F{};
    for (int b = begin_[i]; b < begin_[i + 1]; ++b) {
      Vec<Pack, place> x_j;
      gather<place, width>(rows_[0].c, &j_[static_cast<std::size_t>(lanes) * b], x_j.c);
      Vec<Pack, Dim> d;
      for (int k = 0; k < Dim; ++k) d[k] = x_j[k] - x_i[k];
      add_outer(F, filled<Pack>(1), d, g_ij_[b]);
    }
    F_[i] = sum(F);
    const Mat<double, Dim> cof = cofactor(F_[i]);
    const double slope = volumetric_.slope(determinant(F_[i]));
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) rows_[i].c[place + a * Dim + k] = slope * cof(a, k);
  });
}

/// f_i = Σ_j κ φ′(λ) (x_j − x_i)/r + Σ_j (V_i P_i g_ij − V_j P_j g_ji) + contact; then v and the second half
/// of x. The greatest v², m²/s².
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::force_pass(double dt) {
  drives_.set_time(this->time_ + dt);
  const bool contact = contact_.active(), driven = drives_.active();
  return parallel_max(s_.size(), threads_now(), [&](int i) {
    const Vec<Pack, Dim> x_i = spread(stored_place(i));
    Vec<Pack, Dim> f{};
    for (int b = begin_[i]; b < begin_[i + 1]; ++b) {
      Vec<Pack, width> other;  // x_j, then P_j
      gather<width>(rows_[0].c, &j_[static_cast<std::size_t>(lanes) * b], other.c);
      const BondPack& bond = bonds_[b];
      Vec<Pack, Dim> d;
      for (int k = 0; k < Dim; ++k) d[k] = other[k] - x_i[k];
      const Pack r2 = dot(d, d);
      const Pack inv_r = 1 / root(r2 == 0 ? filled<Pack>(c_.dp * c_.dp) : r2);  // the filling: κ = 0
      const Pack lambda = max(Pack(r2 * inv_r * bond.inv_r0), filled<Pack>(1e-3));
      f += Pack(bond.kappa * bond_slope(lambda) * inv_r) * d;
      for (int a = 0; a < Dim; ++a)
        for (int k = 0; k < Dim; ++k) f[a] -= other[place + a * Dim + k] * bond.V_j_g_ji[k];
    }
    V force = sum(f);
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) force[a] += rows_[i].c[place + a * Dim + k] * sum_V_i_g_ij_[i][k];
    if (contact) force += contact_.force(i);
    V v = s_.v[i];
    v += (dt * s_.mobile[i] / s_.m[i]) * force;
    if (driven) drives_.replace(s_, i, v);
    s_.v[i] = v;
    s_.x[i] += (0.5 * dt) * v;
    return dot(v, v);
  });
}

/// J (per metre depth in 2D): its own U and half of each bond's.
template <const Formulation& M, int Dim>
double Bonded<M, Dim>::strain_energy(int i) const {
  Pack bonds{};
  const Vec<Pack, Dim> x_i = spread(stored_place(i));
  for (int b = begin_[i]; b < begin_[i + 1]; ++b) {
    Vec<Pack, place> x_j;
    gather<place, width>(rows_[0].c, &j_[static_cast<std::size_t>(lanes) * b], x_j.c);
    Vec<Pack, Dim> d;
    for (int k = 0; k < Dim; ++k) d[k] = x_j[k] - x_i[k];
    const Pack lambda = max(Pack(root(dot(d, d)) * bonds_[b].inv_r0), filled<Pack>(1e-3));
    bonds += bonds_[b].kappa / bonds_[b].inv_r0 * bond_energy(lambda);
  }
  return s_.m[i] / c_.rho0 * volumetric_.energy(determinant(F_[i])) + 0.5 * sum(bonds);
}

/// The stress shown is the neo-Hookean one of F: p = −K (J − 1), s = G J^(−5/3) dev(F Fᵀ) with (F Fᵀ)_zz = 1
/// in 2D.
template <const Formulation& M, int Dim>
void Bonded<M, Dim>::take_snapshot() {
  set_rows();
  deformation_pass();
  Base::begin_snapshot();
  std::vector<double>& energy = this->snapshot_.strain_energy;
  energy.resize(s_.size());
  parallel_for(s_.size(), threads_now(), [&](int i) {
    const Mat<double, Dim>& F = F_[i];
    const double J = determinant(F);
    Sym<double, Dim> b{};
    for (int a = 0; a < Dim; ++a)
      for (int k = a; k < Dim; ++k)
        for (int l = 0; l < Dim; ++l) b(a, k) += F(a, l) * F(k, l);
    const double mean = (trace(b) + (3 - Dim)) / 3, scale = c_.G * std::pow(J, -5.0 / 3);
    for (int k = 0; k < Dim; ++k) b(k, k) -= mean;
    Base::store(i, c_.rho0 / J, -c_.K * (J - 1), scale * b, scale * (1 - mean));
    energy[s_.id[i]] = strain_energy(i);
  });
}

}  // namespace taut::inline TAUT_ISA
