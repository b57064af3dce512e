#pragma once

#include <algorithm>
#include <cmath>

#include "engine/families/ul_cauchy/passes.hpp"
#include "engine/solver/particle_solver.hpp"
#include "engine/terms/artificial_stress.hpp"
#include "engine/terms/equation_of_state.hpp"
#include "engine/terms/stress_rate.hpp"

namespace taut::inline TAUT_ISA {

/// The updated-Lagrangian methods whose Cauchy stress σ = −pI + s acts as a whole: those of [Khayyer2024] and
/// the current-configuration ones of [TranDuc2023].
///
/// Lists of neighbours reach a skin farther than the kernel, and hold until a particle has gone half the skin
/// against the motion of its body as a rigid one; what lies beyond the kernel's support has no weight.
template <const Formulation& M, int Dim>
class UlCauchy final : public ParticleSolver<UlCauchy<M, Dim>, Dim> {
 public:
  explicit UlCauchy(const SolverInput& input)
      : Base(input, Kernel<M.kernel>::support * input.constants.h), materials_(input.materials) {
    const std::size_t n = s_.v.size();
    s_.rho.assign(n, 0), s_.drho.assign(n, 0), s_.s.assign(n, {});
    for (int i = 0; i < s_.size(); ++i) {
      s_.rho[i] = material(i).rho0;
      if (s_.material[i] != s_.material[0]) several_materials_ = true;
    }
    if (s_.sph_contact) refuse_contact_forces(input.scene);
    f_.resize_particles(s_.size());
    rebuild();
    Base::record();
  }

  /// s, [Khayyer2024] Eq. 26, with c0 wherever shear is as soft as there
  double step_size() const { return Base::fixed_or(c_.cfl * c_.h / c_.step_speed); }
  void step(double dt);
  void prepare_to_show() {}
  void show(int group);
  template <class Archive>
  void serialize(Archive& archive) {
    Base::serialize(archive);
    archive(f_);
    archive.fixed(drift_, spin_, centre_);
    archive(way_);
  }

 private:
  using Base = ParticleSolver<UlCauchy<M, Dim>, Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::drives_, Base::guides_, Base::recorder_, Base::support_,
      Base::threads_now, Base::vmax_;
  using typename Base::V;
  using S = Sym<double, Dim>;

  /// Longer: fewer searches, more pairs; in spacings.
  static constexpr double skin = 0.25;

  const Elasticity& material(int i) const { return materials_[s_.material[i]]; }
  static void refuse_contact_forces(const Scene& scene);
  void rebuild();
  void show_neighbors_to_probes();
  void mark_materials();
  void set_motion();
  void set_rigid_motion();
  void set_stress(int i, const Gradients<Dim>& g);
  void accelerate(double dt);
  void transport(double dt);
  void advance_fields(double dt);

  std::vector<Elasticity> materials_;
  bool several_materials_ = false;
  CellGrid<Dim> grid_;
  NeighborSearch<Dim> search_;
  CauchyFields<M, Dim> f_;
  // of each body as a rigid one, when neighbours were last searched; several that act as one have none
  std::vector<V> drift_;      // m/s
  std::vector<double> spin_;  // 1/s
  std::vector<V> centre_;     // where it has drifted to since, m
  double way_ = 0;            // against that motion since, of the particle that goes farthest, m
};

/// Bodies that act on each other as one do so by all of their stress, in the sums over all neighbours.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::refuse_contact_forces(const Scene& scene) {
  for (const Probe& probe : scene.probes)
    if (probe.kind == Probe::Kind::contact_force && probe.wall < 0)
      throw SceneError("probe." + probe.name,
                       "the probe '" + probe.name +
                           "' has no force to measure: with contact = \"sph\" the method '" +
                           std::string(M.name) +
                           "' takes two bodies that touch for one; take another law, such as \"penalty\"");
}

/// One step of the symplectic Euler scheme.
/// Differs from [Khayyer2024] Eq. 22–25, where all rates are those of the old state: an elastic wave grows
/// without limit that way. ∇u is taken in the middle of the step (`geometry` = ½): at its start, as printed,
/// a body that turns with ω swells by (ω dt)²/2 a step and has no strain of it.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::step(double dt) {
  if (2 * way_ > skin * c_.dp) rebuild();
  if (contact_.prepare(s_, vmax_ * dt)) show_neighbors_to_probes();
  contact_.evaluate(s_, dt, threads_now());
  gradient_pass(f_, c_, threads_now(), [&](int i, const Gradients<Dim>& g) { set_stress(i, g); });
  accelerate(dt);
  transport(dt);
  advance_fields(dt);
  Base::finish_step(dt);
}
inline constexpr TermInfo ul_cauchy_time_info{
    "time", "symplectic Euler, rates at the middle of the step or where `geometry` says",
    "[Khayyer2024] Eq. 22–26", "families/ul_cauchy/solver.hpp:step",
    "naive: the ladder, a clamped plate of two materials and a disc that hits it"};

/// T and R, and what else the stress pass gathers.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::set_stress(int i, const Gradients<Dim>& g) {
  using Row = StressRow<M, Dim>;
  Row& row = f_.stress[i];
  const double rho = s_.rho[i], c0 = material(i).c0;
  row.put(Row::v_at, s_.v[i]);
  row.put(Row::rho_at, rho);
  row.put(Row::V_at, s_.m[i] / rho);
  S sigma = s_.s[i];
  for (int k = 0; k < Dim; ++k) sigma(k, k) -= pressure(rho, material(i).rho0, c0);
  const double scale = M.pair_stress == PairStress::squares ? 1 / (rho * rho) : 1;
  const auto acting = [&](const S& stress) {
    if constexpr (M.corrected)
      return product(stress, g.L);
    else
      return full(scale * stress);
  };
  row.put(Row::T_at, acting(sigma));
  if constexpr (M.artificial_stress) f_.repulsion[i].set(acting(-1.0 * positive_part(sigma)));
  if constexpr (M.viscosity == Viscosity::artificial) row.put(Row::wave_at, c0);
  if constexpr (M.viscosity == Viscosity::riemann) {
    row.put(Row::D_at, g.D);
    row.put(Row::root_rho_at, std::sqrt(rho));
    row.put(Row::wave_at, c0 * rho * std::sqrt(rho));
  }
  if constexpr (M.density_diffusion) row.put(Row::grad_rho_at, g.grad_rho);
  if constexpr (M.tensile_control) row.put(Row::surface_at, g.colour < c_.surface_colour);
}

/// Velocities over the whole step, from the stresses of its start and the contact of bodies.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::accelerate(double dt) {
  const typename Base::Kick kick(*this, dt, this->time_ + 0.5 * dt);
  const double v2 = stress_pass(f_, c_, threads_now(), [&](int i, const V& a, double density_diffusion) {
    const V v = kick.by_acceleration(i, a);
    s_.drho[i] = density_diffusion;
    f_.moved[i] = f_.motion[i];
    f_.moved[i].put_velocity(v);
    return dot(v, v);
  });
  Base::set_greatest_speed(v2);
  Base::stop_approach(0, [&](int i, const V&) { f_.moved[i].put_velocity(s_.v[i]); });
}

/// û from the new velocities. Held particles stay, guided and driven ones go as they are told.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::transport(double dt) {
  const auto use = [&](int i, const V& du) {
    V u = s_.v[i];
    if (!drives_.moves(s_.id[i])) {
      u += s_.mobile[i] * du;
      guides_.hold(s_.id[i], u);
    }
    V x = s_.x[i];
    x += (c_.geometry * dt) * u;
    f_.transported[i].set(u, s_.rho[i], s_.m[i] / s_.rho[i], x);
    const int body = s_.body[i];
    V against = u - drift_[body];
    const V arm = s_.x[i] - centre_[body];
    against[0] += spin_[body] * arm[1], against[1] -= spin_[body] * arm[0];
    return dot(against, against);
  };
  double fastest2 = 0;
  if constexpr (M.transport_velocity)
    fastest2 = transport_pass(f_, c_, threads_now(), use);
  else
    fastest2 = parallel_max(s_.size(), threads_now(), [&](int i) { return use(i, V{}); });
  way_ += dt * std::sqrt(fastest2);
  for (std::size_t body = 0; body < drift_.size(); ++body) centre_[body] += dt * drift_[body];
  // a pair that turns by ω dt along its tangents parts by the square of that: each end by a quarter
  const double turn = dt * *std::ranges::max_element(spin_, {}, [](double spin) { return std::abs(spin); });
  way_ += 0.25 * turn * turn * (support_ + skin * c_.dp);
}

/// Densities, stresses and positions with the rates of the new velocities.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::advance_fields(double dt) {
  rate_pass(f_, c_, threads_now(), [&](int i, const Mat<double, Dim>& L, double drho) {
    s_.rho[i] += dt * (drho + s_.drho[i]);
    s_.s[i] = turned_stress<M.deviator>(L, s_.s[i], material(i).G, dt);
    for (int k = 0; k < Dim; ++k) s_.x[i][k] += dt * f_.transported[i].c[k];
    f_.motion[i].set(s_.v[i], s_.rho[i], s_.m[i] / s_.rho[i], s_.x[i]);
  });
}

/// Particles to the order of their cells, and the lists of neighbours.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::rebuild() {
  const double reach = support_ + skin * c_.dp;
  s_.reorder(grid_.sort(s_.x, reach), threads_now());
  if (contact_.between_bodies())
    search_(grid_, s_.x, reach, threads_now(), f_.near,
            [this](int i, int j) { return s_.body[i] == s_.body[j]; });
  else
    search_(grid_, s_.x, reach, threads_now(), f_.near);
  this->pairs_ = f_.near.pairs;
  f_.resize_pairs();
  mark_materials();
  set_motion();
  set_rigid_motion();
  contact_.search(s_);
  show_neighbors_to_probes();
  way_ = 0;
}

/// Pairs of two bodies are in the lists only where they act as in one.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::show_neighbors_to_probes() {
  if (!s_.sph_contact) return Base::show_contacts_to_probes();
  s_.neighbors = f_.near;
  recorder_.rebuilt(s_, s_.neighbors, support_);
}

template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::mark_materials() {
  if (!M.density_diffusion || !several_materials_) return;
  f_.of_one_material.resize(f_.near.begin.back());
  parallel_for(s_.size(), threads_now(), [&](int i) {
    for (int b = f_.near.begin[i]; b < f_.near.begin[i + 1]; ++b)
      for (int lane = 0; lane < lanes; ++lane)
        f_.of_one_material[b].value[lane] = s_.material[f_.near.pack(b)[lane]] == s_.material[i];
  });
}

/// The rows of the particles in their new order.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::set_motion() {
  for (int i = 0; i < s_.size(); ++i) f_.motion[i].set(s_.v[i], s_.rho[i], s_.m[i] / s_.rho[i], s_.x[i]);
}

/// Of each body its velocity and spin, from both momenta; any other would be as right, with more searches.
template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::set_rigid_motion() {
  static_assert(Dim == 2);
  const std::size_t bodies = this->initial_.first.size() - 1;
  std::vector<double> mass(bodies), inertia(bodies);
  drift_.assign(bodies, V{}), centre_.assign(bodies, V{}), spin_.assign(bodies, 0);
  if (s_.sph_contact) return;
  for (int i = 0; i < s_.size(); ++i) {
    const int body = s_.body[i];
    mass[body] += s_.m[i];
    drift_[body] += s_.m[i] * s_.v[i], centre_[body] += s_.m[i] * s_.x[i];
  }
  for (std::size_t body = 0; body < bodies; ++body)
    drift_[body] = (1 / mass[body]) * drift_[body], centre_[body] = (1 / mass[body]) * centre_[body];
  for (int i = 0; i < s_.size(); ++i) {
    const int body = s_.body[i];
    const V arm = s_.x[i] - centre_[body], v = s_.v[i] - drift_[body];
    inertia[body] += s_.m[i] * dot(arm, arm);
    spin_[body] += s_.m[i] * (arm[0] * v[1] - arm[1] * v[0]);
  }
  for (std::size_t body = 0; body < bodies; ++body)
    spin_[body] = inertia[body] > 0 ? spin_[body] / inertia[body] : 0;
}

template <const Formulation& M, int Dim>
void UlCauchy<M, Dim>::show(int group) {
  for (int i = lanes * group; i < std::min(lanes * (group + 1), s_.size()); ++i) {
    const double p = pressure(s_.rho[i], material(i).rho0, material(i).c0);
    Base::store(i, s_.rho[i], p, s_.s[i], -trace(s_.s[i]));
  }
}

}  // namespace taut::inline TAUT_ISA
