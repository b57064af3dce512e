#pragma once

#include <algorithm>

#include "engine/families/ul_split/passes.hpp"
#include "engine/solver/particle_solver.hpp"

namespace taut::inline TAUT_ISA {

/// The updated-Lagrangian methods of [Zhang2024] with the position-based Verlet scheme and the dual-criteria
/// time stepping of its §5.
template <const Formulation& M, int Dim>
class UlSplit final : public ParticleSolver<UlSplit<M, Dim>, Dim> {
 public:
  explicit UlSplit(const SolverInput& input)
      : Base(input, Kernel<M.kernel>::support * input.constants.h), stepping_(input.stepping) {
    make_room();
    rebuild();
    greatest_speed_ = vmax_;
    Base::record();
  }

  void step(double dt);
  void prepare_to_show();
  void show(int group);
  template <class Archive>
  void serialize(Archive& archive) {
    Base::serialize(archive);
    archive(greatest_speed_, advected_);
  }

 private:
  using Base = ParticleSolver<UlSplit<M, Dim>, Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::drives_, Base::recorder_, Base::vmax_, Base::support_,
      Base::threads_now;
  using typename Base::V;
  static constexpr bool nested = carries_stress(M);

  void make_room();
  void rebuild();
  void half_drift(double dt);
  void accelerate(double dt);
  void close_rates(double dt);
  void take_rates_at_start();
  template <bool pressure_diffusion>
  void rates(double dt);
  void set_recovery_displacements();
  V contact_force(const Probe& probe, double dt) override;

  Stepping stepping_;
  CellGrid<Dim> grid_;
  NeighborSearch<Dim> search_;
  double greatest_speed_ = 0;  // m/s, so far
  double advected_ = 0;        // way at the greatest speed since the last rebuild, m
};

/// One acoustic step, [Zhang2024] Eq. 22–25.
template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::step(double dt) {
  // Eq. 21 as a distance, and with the greatest speed so far: a body that speeds up within an advection step
  // is rebuilt in time, and one at the turning point of its swing is not left with pairs from long ago.
  if (stepping_ == Stepping::single ? this->step_ > 0 : advected_ >= c_.cfl_advection * c_.h) rebuild();
  contact_.prepare(s_, vmax_ * dt);
  half_drift(0.5 * dt);
  contact_geometry_pass<M>(s_, c_);
  contact_.evaluate(s_, dt, threads_now());
  accelerate(dt);
  close_rates(0.5 * dt);
  advected_ += greatest_speed_ * dt;
  Base::finish_step(dt);
}
inline constexpr TermInfo ul_split_time_info{"time", "position Verlet, dual-criteria steps",
                                             "[Zhang2024] Eq. 21–25", "families/ul_split/solver.hpp:step",
                                             "naive: a ring and a disc that collide, dual stepping"};

/// Positions, densities and shear to the middle of the step, Eq. 23.
template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::half_drift(double dt) {
  parallel_pass(s_.size(), threads_now(), [&](int i) {
    s_.x[i] += dt * s_.v[i];
    s_.rho[i] += dt * s_.drho[i];
    const double p = pressure(s_.rho[i], c_.rho0, c_.c0);
    s_.flow[i].set(s_.v[i], p, s_.m[i] / s_.rho[i]);
    if constexpr (nested) {
      s_.s[i] += dt * s_.ds[i];
      s_.stress[i].set(s_.s[i]);
    } else {
      s_.a_shear[i] += dt * s_.da_shear[i];
    }
    if constexpr (M.artificial_stress) {
      Sym<double, Dim> sigma = s_.s[i];
      for (int k = 0; k < Dim; ++k) sigma(k, k) -= p;
      s_.repulsion[i].set(artificial_stress(sigma, s_.rho[i], c_.epsilon), s_.m[i]);
    }
  });
}

/// Velocities over the whole step, Eq. 24, and positions to its end, Eq. 25.
template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::accelerate(double dt) {
  const typename Base::Kick kick(*this, dt, this->time_ + dt);
  const double vmax2 = momentum_pass<M>(s_, c_, threads_now(), [&](int i, const V& a) {
    const V v = kick.by_acceleration(i, a);
    s_.x[i] += (0.5 * dt) * v;
    const FlowRow<Dim>& old = s_.flow[i];
    s_.flow_new[i].set(v, old.c[Dim], old.c[Dim + 1]);
    return dot(v, v);
  });
  Base::set_greatest_speed(vmax2);
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) {
    s_.x[i] += (0.5 * dt) * change;
    const FlowRow<Dim>& old = s_.flow[i];
    s_.flow_new[i].set(s_.v[i], old.c[Dim], old.c[Dim + 1]);
  });
  greatest_speed_ = std::max(greatest_speed_, vmax_);
}

/// Densities and shear to the end of the step, with the rates of the new velocities, Eq. 25.
template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::close_rates(double dt) {
  if (c_.pressure_diffusion == 0)
    rates<false>(dt);
  else
    rates<true>(dt);
}

template <const Formulation& M, int Dim>
template <bool pressure_diffusion>
void UlSplit<M, Dim>::rates(double dt) {
  rate_pass<M, Dim, pressure_diffusion>(s_, c_, threads_now(), [&](int i) {
    if constexpr (!strains_what_is_held(M))
      if (drives_.moves(s_.id[i])) s_.drho[i] = 0;
    s_.rho[i] += dt * s_.drho[i];
    if constexpr (nested)
      s_.s[i] += dt * s_.ds[i];
    else
      s_.a_shear[i] += dt * s_.da_shear[i];
  });
}

/// The arrays that the method uses.
template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::make_room() {
  const std::size_t n = s_.size();
  s_.rho.assign(n, c_.rho0);
  s_.drho.assign(n, 0);
  s_.s.assign(n, {});
  s_.flow.resize(n);
  s_.flow_new.resize(n);
  if constexpr (nested) {
    s_.ds.assign(n, {});
    s_.stress.resize(n);
  } else {
    s_.a_shear.assign(n, V{});
    s_.da_shear.assign(n, V{});
    s_.x_recovered = s_.x;
    s_.recovery.resize(n);
  }
  if constexpr (M.artificial_stress) s_.repulsion.resize(n);
}

/// The configuration is updated: particles to the order of their cells, neighbours, geometry of pairs.
template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::rebuild() {
  if constexpr (!nested) {
    if (this->step_ > 0) {
      set_recovery_displacements();
      stress_recovery_pass<M>(s_, c_, threads_now(), [&](int i, const Sym<double, Dim>& s) { s_.s[i] = s; });
      s_.x_recovered = s_.x;
    }
  }
  s_.reorder(grid_.sort(s_.x, support_), threads_now());
  search_(grid_, s_.x, support_, threads_now(), s_.neighbors);
  this->pairs_ = s_.neighbors.pairs;
  geometry_pass<M>(s_, c_, threads_now());
  contact_.search(s_);
  recorder_.rebuilt(s_, s_.neighbors, support_);
  advected_ = 0;
  if (this->step_ == 0) take_rates_at_start();
}

/// The rates at t = 0, which the first half step needs.
template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::take_rates_at_start() {
  for (int i = 0; i < s_.size(); ++i) s_.flow_new[i].set(s_.v[i], 0, s_.m[i] / s_.rho[i]);
  close_rates(0);
}

template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::set_recovery_displacements() {
  parallel_for(s_.size(), threads_now(),
               [&](int i) { s_.flow_new[i].set(s_.x[i] - s_.x_recovered[i], 0, s_.recovery[i].scalar()); });
}

template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::prepare_to_show() {
  if constexpr (!nested) set_recovery_displacements();
}

template <const Formulation& M, int Dim>
void UlSplit<M, Dim>::show(int group) {
  for (int i = lanes * group; i < std::min(lanes * (group + 1), s_.size()); ++i) {
    Sym<double, Dim> s = s_.s[i];
    if constexpr (!nested) s = recovered_stress<M>(s_, c_, i);
    Base::store(i, s_.rho[i], pressure(s_.rho[i], c_.rho0, c_.c0), s,
                M.deviator == Deviator::plane_strain ? -trace(s) : 0);
  }
}

/// Bodies that act on each other as one do so by pressure, and by artificial stress.
template <const Formulation& M, int Dim>
auto UlSplit<M, Dim>::contact_force(const Probe& probe, double dt) -> V {
  if (probe.wall >= 0 || !s_.sph_contact) return Base::contact_force(probe, dt);
  return force_between<M>(s_, c_, probe.bodies[0], probe.bodies[1]);
}

}  // namespace taut::inline TAUT_ISA
