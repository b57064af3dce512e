#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/team_size.hpp"
#include "engine/error.hpp"
#include "engine/layout.hpp"
#include "engine/methods/constants.hpp"
#include "engine/simulation.hpp"
#include "engine/solver/passes.hpp"
#include "engine/solver/recorder.hpp"
#include "engine/solver/solver.hpp"

namespace taut::inline TAUT_ISA {

/// Beyond this multiple of the sound speed the steps shrink without end: the run has diverged.
inline constexpr double greatest_mach_number = 10;

/// The updated-Lagrangian methods of [Zhang2024] with the position-based Verlet scheme and the dual-criteria
/// time stepping of its §5.
template <const Formulation& M, int Dim>
class UpdatedLagrangian final : public Simulation {
 public:
  explicit UpdatedLagrangian(const SolverInput& setup)
      : c_(setup.constants),
        stepping_(setup.stepping),
        layout_(setup.layout),
        team_(setup.threads),
        recorder_(setup.scene, setup.layout, Kernel<M.kernel>::support * setup.constants.h) {
    threads_ = setup.threads;
    support_ = Kernel<M.kernel>::support * c_.h;
    place_particles();
    rebuild();
    vmax_ = parallel_max(s_.size(), team_.threads(), [&](int i) { return std::sqrt(dot(s_.v[i], s_.v[i])); });
    greatest_speed_ = vmax_;
    recorder_.record(s_, time_, series_);
    take_snapshot();
  }

  void advance_to(double t) override {
    team_.resume();
    while (time_ < t) {
      step();
      team_.step_done();
    }
    take_snapshot();
  }

 private:
  using V = Vec<double, Dim>;
  static constexpr bool nested = carries_stress(M);

  void place_particles();
  void rebuild();
  void reorder(const std::vector<int>& order);
  void step();
  void half_drift(double dt);
  void kick(double dt);
  void close_rates(double dt);
  void advance_rates_at_rest();
  template <bool pressure_diffusion>
  void rates(double dt);
  void set_recovery_displacements();
  void take_snapshot();
  [[noreturn]] void fail() const;

  Constants c_;
  Stepping stepping_;
  Layout layout_;
  TeamSize team_;
  State<Dim> s_;
  CellGrid<Dim> grid_;
  NeighborSearch<Dim> search_;
  Recorder<Dim> recorder_;
  double time_ = 0;  // s
  long step_ = 0;
  double vmax_ = 0;            // m/s
  double greatest_speed_ = 0;  // m/s, so far
  double advected_ = 0;        // way at the greatest speed since the last rebuild, m
};

/// One acoustic step, [Zhang2024] Eq. 22–25.
template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::step() {
  // Eq. 21 as a distance, and with the greatest speed so far: a body that speeds up within an advection step
  // is rebuilt in time, and one at the turning point of its swing is not left with pairs from long ago.
  if (stepping_ == Stepping::single ? step_ > 0 : advected_ >= c_.cfl_advection * c_.h) rebuild();
  const double dt = c_.cfl * c_.h / (c_.c0 + vmax_);
  half_drift(0.5 * dt);
  contact_geometry_pass<M>(s_, c_);
  kick(dt);
  close_rates(0.5 * dt);
  time_ += dt;
  advected_ += greatest_speed_ * dt;
  ++step_;
  recorder_.record(s_, time_, series_);
}

/// Positions, densities and shear to the middle of the step, Eq. 23.
template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::half_drift(double dt) {
  parallel_for(s_.size(), team_.threads(), [&](int i) {
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
void UpdatedLagrangian<M, Dim>::kick(double dt) {
  const double vmax2 = momentum_pass<M>(s_, c_, team_.threads(), [&](int i, const V& a) {
    V v = s_.v[i];
    v += (dt * s_.mobile[i]) * a;
    s_.v[i] = v;
    s_.x[i] += (0.5 * dt) * v;
    const FlowRow<Dim>& old = s_.flow[i];
    s_.flow_new[i].set(v, old.c[Dim], old.c[Dim + 1]);
    return dot(v, v);
  });
  vmax_ = std::sqrt(vmax2);
  greatest_speed_ = std::max(greatest_speed_, vmax_);
  if (!(vmax_ <= greatest_mach_number * c_.c0)) fail();
}

/// Densities and shear to the end of the step, with the rates of the new velocities, Eq. 25.
template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::close_rates(double dt) {
  if (c_.pressure_diffusion == 0)
    rates<false>(dt);
  else
    rates<true>(dt);
}

template <const Formulation& M, int Dim>
template <bool pressure_diffusion>
void UpdatedLagrangian<M, Dim>::rates(double dt) {
  rate_pass<M, Dim, pressure_diffusion>(s_, c_, team_.threads(), [&](int i) {
    s_.rho[i] += dt * s_.drho[i];
    if constexpr (nested)
      s_.s[i] += dt * s_.ds[i];
    else
      s_.a_shear[i] += dt * s_.da_shear[i];
  });
}

template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::place_particles() {
  const int n = layout_.size();
  const auto point = [](const Point& p) {
    V v;
    for (int k = 0; k < Dim; ++k) v[k] = p[k];
    return v;
  };
  for (int i = 0; i < n; ++i) {
    s_.x.push_back(point(layout_.x[i]));
    s_.v.push_back(point(layout_.v[i]));
    s_.m.push_back(c_.rho0 * layout_.V0[i]);
    s_.mobile.push_back(layout_.held[i] ? 0 : 1);
  }
  s_.rho.assign(n, c_.rho0);
  s_.drho.assign(n, 0);
  s_.s.assign(n, {});
  s_.id.resize(n);
  std::iota(s_.id.begin(), s_.id.end(), 0);
  s_.body = layout_.body;
  s_.several_bodies = layout_.first.size() > 2;
  s_.flow.resize(n);
  s_.flow_new.resize(n);
  if constexpr (nested) {
    s_.ds.assign(n, {});
    s_.stress.resize(n);
  } else {
    s_.a_shear.assign(n, V{});
    s_.da_shear.assign(n, V{});
    s_.x_recovered = s_.x;
  }
  if constexpr (M.artificial_stress) s_.repulsion.resize(n);
}

/// The configuration is updated: particles to the order of their cells, neighbours, geometry of pairs.
template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::rebuild() {
  if constexpr (!nested) {
    if (step_ > 0) {
      set_recovery_displacements();
      stress_recovery_pass<M>(s_, c_, team_.threads(),
                              [&](int i, const Sym<double, Dim>& s) { s_.s[i] = s; });
      s_.x_recovered = s_.x;
    }
  }
  reorder(grid_.sort(s_.x, support_));
  search_(grid_, s_.x, support_, team_.threads(), s_.neighbors);
  pairs_ = s_.neighbors.pairs;
  geometry_pass<M>(s_, c_, threads_);
  recorder_.rebuilt(s_, support_);
  advected_ = 0;
  if (step_ == 0) advance_rates_at_rest();
}

/// The rates at t = 0, which the first half step needs.
template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::advance_rates_at_rest() {
  for (int i = 0; i < s_.size(); ++i) s_.flow_new[i].set(s_.v[i], 0, s_.m[i] / s_.rho[i]);
  close_rates(0);
}

template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::reorder(const std::vector<int>& order) {
  const auto apply = [&](auto& array) {
    if (array.empty()) return;
    auto sorted = array;
    parallel_for(s_.size(), team_.threads(), [&](int i) { sorted[i] = array[order[i]]; });
    array.swap(sorted);
  };
  apply(s_.x), apply(s_.v), apply(s_.m), apply(s_.mobile), apply(s_.rho), apply(s_.drho), apply(s_.id),
      apply(s_.body);
  apply(s_.a_shear), apply(s_.da_shear), apply(s_.s), apply(s_.ds), apply(s_.x_recovered);
}

template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::set_recovery_displacements() {
  parallel_for(s_.size(), team_.threads(),
               [&](int i) { s_.flow_new[i].set(s_.x[i] - s_.x_recovered[i], 0, s_.m[i] / s_.rho[i]); });
}

/// Names the particle that went wrong first in the order of creation.
template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::fail() const {
  const double limit = greatest_mach_number * c_.c0;
  int culprit = s_.size();  // id
  for (int i = 0; i < s_.size(); ++i)
    if (!(dot(s_.v[i], s_.v[i]) <= limit * limit)) culprit = std::min(culprit, s_.id[i]);
  throw NumericalError(step_, time_, culprit, "velocity",
                       "particle " + std::to_string(culprit) + " is faster than " + std::to_string(limit) +
                           " m/s (" + std::to_string(greatest_mach_number) + " c0) or not a number");
}

template <const Formulation& M, int Dim>
void UpdatedLagrangian<M, Dim>::take_snapshot() {
  constexpr int S = Sym<double, Dim>::size + (Dim == 2);  // in 2D s_zz is stored too
  const std::size_t n = s_.size();
  Snapshot& out = snapshot_;
  if (out.m.empty()) {
    out.dim = Dim;
    out.x0.resize(n * Dim), out.x.resize(n * Dim), out.v.resize(n * Dim);
    out.m.resize(n), out.rho.resize(n), out.p.resize(n), out.s.resize(n * S), out.diameter.resize(n);
    out.body = layout_.body;
    out.held = layout_.held;
    for (std::size_t i = 0; i < n; ++i) {
      for (int k = 0; k < Dim; ++k) out.x0[i * Dim + k] = layout_.x[i][k];
      out.diameter[i] = std::pow(layout_.V0[i], 1.0 / Dim);
    }
  }
  out.time = time_;
  out.step = step_;
  const auto store = [&](int i, const Sym<double, Dim>& s) {
    const std::size_t id = s_.id[i];
    for (int k = 0; k < Dim; ++k) {
      out.x[id * Dim + k] = s_.x[i][k];
      out.v[id * Dim + k] = s_.v[i][k];
    }
    out.m[id] = s_.m[i];
    out.rho[id] = s_.rho[i];
    out.p[id] = pressure(s_.rho[i], c_.rho0, c_.c0);
    for (int k = 0; k < Sym<double, Dim>::size; ++k) out.s[id * S + k] = s.c[k];
    if constexpr (Dim == 2) out.s[id * S + 3] = M.deviator == Deviator::plane_strain ? -trace(s) : 0;
  };
  if constexpr (nested) {
    parallel_for(s_.size(), team_.threads(), [&](int i) { store(i, s_.s[i]); });
  } else {
    set_recovery_displacements();
    stress_recovery_pass<M>(s_, c_, team_.threads(), store);
  }
}

}  // namespace taut::inline TAUT_ISA
