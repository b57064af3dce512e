#pragma once

#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "engine/families/tl_mixed/corrected_laplacian.hpp"
#include "engine/families/tl_mixed/momentum_projection.hpp"
#include "engine/families/tl_mixed/prescribed_boundary.hpp"
#include "engine/solver/initial_pair_solver.hpp"

namespace taut::inline TAUT_ISA {

/// Beyond this multiple of c_p in the strained body the steps shrink without end: the run has diverged.
inline constexpr double greatest_wave_ratio = 100;

/// Mixed total-Lagrangian methods: momentum, deformation gradient F and, where the method says so, volume
/// ratio J and cofactor H of F as unknowns of equations of their own, with Jameson–Schmidt–Turkel dissipation.
/// [Lee2016] Algorithm 1. The momentum goes as the velocity p/ρ0. In plane strain H is linear in F, and its
/// equation says nothing that that of F does not: there {p, F, H, J} runs as {p, F, J}.
///
/// Differs from the paper in the biharmonic term, L*[L[U]] with the adjoint of L in place of L[L[U]] (Eq.
/// 37b). L is not symmetric at a surface, where its square may feed what it is to damp: with it `pfj-jst`
/// loses the bending column at Poisson's ratio 0.499 for ε of J from 1/32 on, at any time step. The adjoint
/// takes from every field (−Σ V |L[U]|²) and is the same inside. The constant `adjoint` = 0 gives the printed
/// form. Boundary conditions are set on the particles themselves (its step 8), and where the kernel looks (step
/// 9, "usually disregarded") with `boundary_projection` = 1. Forces of contact, which it has not, act outside
/// the projection and are taken at its Z, about which central forces have no moment; so do loads. Of the
/// dissipation and the internal force the sum is projected, which is the same as each of them (Eq. 49).
template <const Formulation& M, int Dim>
class TlMixed final : public InitialPairSolver<TlMixed<M, Dim>, M, Dim> {
 public:
  explicit TlMixed(const SolverInput& input);

  void step();
  template <class Archive>
  void serialize(Archive& archive) {
    Base::serialize(archive);
    archive(now_);
  }

 private:
  using Base = InitialPairSolver<TlMixed<M, Dim>, M, Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::drives_, Base::guides_, Base::loads_, Base::threads_now,
      Base::vmax_;
  using Base::initial_, Base::initial_pairs_, Base::V0_, Base::X_;
  using typename Base::Mat;
  using typename Base::V;

  static constexpr bool has_J = follows_volume_ratio(M);
  static constexpr bool has_H = M.unknowns == Unknowns::v_F_H_J && Dim == 3;
  struct None {};

  /// Unknowns of a particle, or their rates.
  struct Unknown {
    V x, v;  // m, m/s
    Mat F;
    double J;  // where it is one
    [[no_unique_address]] std::conditional_t<has_H, Mat, None> H{};
  };

  static double volume_ratio(const Unknown& u) { return has_J ? u.J : determinant(u.F); }
  static Mat cofactors(const Unknown& u) {
    if constexpr (has_H)
      return u.H;
    else
      return cofactor(u.F);
  }
  template <class L>
  static Mat piola(const L& law, const Unknown& u) {
    if constexpr (has_H)
      return law.piola(u.F, u.H, u.J);
    else
      return law.piola(u.F, volume_ratio(u));
  }
  /// `u` + Δt `rate`
  static void add(Unknown& u, double dt, const Unknown& rate);

  double greatest_step_of_dissipation() const;
  double step_size() const;
  [[noreturn]] void crushed() const;
  void set_start_gradients();
  void find_rates(const std::vector<V>& Z, double dt);
  void set_rows(const std::vector<V>& Z);
  void gather_pass();
  void dissipation_pass();
  void project(const std::vector<V>& Z);
  void project_on_boundary();
  void predict(double dt);
  double correct(double dt);
  void take_snapshot() override;

  std::vector<Unknown> now_, start_;  // at the stage and at the start of the step
  std::vector<Unknown> rate_, rate_of_start_;
  std::vector<V> a_;                   // of internal force and dissipation, m/s²
  std::vector<V> Z_;                   // x at the end of the step, m
  std::vector<double> dissipation_J_;  // 1/s

  std::vector<Tile<Dim>> velocity_;                                     // in rows
  std::vector<Tile<Dim>> stress_;                                       // V P B
  double dissipation_limit_ = std::numeric_limits<double>::infinity();  // s, of the step
  std::vector<double> laplacian_, outer_;  // w_ij dp²; what L[U] of a neighbour counts in the second
  PrescribedBoundary<Kernel<M.kernel>, Dim> boundary_;
  std::vector<StoredPack> smoothed_, once_;  // (v, J) and dp² L of it
};

template <const Formulation& M, int Dim>
TlMixed<M, Dim>::TlMixed(const SolverInput& input)
    : Base(input),
      rate_(s_.size()),
      a_(s_.size()),
      dissipation_J_(s_.size()),
      velocity_(s_.size()),
      stress_(s_.size()) {
  static_assert(Dim + has_J <= lanes);
  Mat one{};
  for (int k = 0; k < Dim; ++k) one(k, k) = 1;
  for (int i = 0; i < s_.size(); ++i) {
    now_.push_back({s_.x[i], s_.v[i], one, 1});
    if constexpr (has_H) now_[i].H = one;
  }
  if (!initial_.start.empty()) set_start_gradients();
  start_ = now_;
  rate_of_start_ = rate_;
  Z_ = s_.x;
  if constexpr (M.jst) {
    laplacian_ = corrected_laplacian<Kernel<M.kernel>>(initial_pairs_, X_, V0_, c_.h, c_.dp * c_.dp);
    outer_ = adjoint_weights(initial_pairs_, laplacian_, V0_);
    for (std::size_t p = 0; p < outer_.size(); ++p)
      outer_[p] = c_.adjoint * outer_[p] + (1 - c_.adjoint) * laplacian_[p];
    smoothed_.resize(s_.size());
    once_.resize(s_.size());
    dissipation_limit_ = greatest_step_of_dissipation();
  }
  this->record();
}

/// Of bodies that start displaced: F is what the kernel sees of their places, as its rate is what it sees of
/// their velocities, J its determinant and H its cofactor.
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::set_start_gradients() {
  for (int i = 0; i < s_.size(); ++i) velocity_[i] = in_rows(s_.x[i] - X_[i]);
  for (int i = 0; i < s_.size(); ++i) {
    const Mat grad_u = product(matrix(initial_pairs_.difference_sum(velocity_, i)), initial_pairs_.B[i]);
    now_[i].F = combination(1.0, now_[i].F, 1.0, grad_u);
    if constexpr (has_J) now_[i].J = determinant(now_[i].F);
    if constexpr (has_H) now_[i].H = cofactor(now_[i].F);
  }
}

/// The step that two Runge–Kutta stages bear of the dissipation, 2 over its greatest rate, less a tenth for the waves
/// that it damps. The paper's step is below it but at the edges of bodies of few layers.
template <const Formulation& M, int Dim>
double TlMixed<M, Dim>::greatest_step_of_dissipation() const {
  const double square = biharmonic_spectral_radius(initial_pairs_, laplacian_, outer_, threads_now()),
               once = std::sqrt(square);
  const double rate = std::max(c_.eps_v2 * once + c_.eps_v4 * square, c_.eps_J2 * once + c_.eps_J4 * square);
  return 0.9 * 2 * c_.dp / (Base::wave_speed() * rate);
}

/// In 3D α_CFL h/c_p with the fastest wave through the strained bodies, seen from their start: waves along a
/// direction that is pressed together cross more of the initial spacings.       [Lee2016] Eq. 44, Alg. 1, step 2
/// Differs from the paper, which has dp for h: at 0.3 dp/c_p zigzags at free faces grow where particles are in the
/// middle of cells (limit 0.25; 0.39 on the boundary); and in the plane, where the greatest speed stands for how
/// fast bodies are strained.
template <const Formulation& M, int Dim>
double TlMixed<M, Dim>::step_size() const {
  if constexpr (Dim == 2) {
    return this->fixed_or(std::min(Base::step_size(), dissipation_limit_));
  } else {
    const double stiffest = this->with_laws([&](const auto& law) {
      return parallel_max(s_.size(), threads_now(),
                          [&](int i) { return law(i).stiffness_bound(now_[i].F, volume_ratio(now_[i])); });
    });
    const double fastest = std::sqrt(stiffest / c_.rho0);
    if (!(fastest <= greatest_wave_ratio * Base::wave_speed())) crushed();
    return this->fixed_or(std::min(c_.cfl * c_.h / fastest, dissipation_limit_));
  }
}

/// Names the first particle in the order of creation in which waves are too fast.
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::crushed() const {
  const double limit = greatest_wave_ratio * Base::wave_speed();
  int culprit = s_.size();  // id
  this->with_laws([&](const auto& law) {
    for (int i = 0; i < s_.size(); ++i)
      if (!(law(i).stiffness_bound(now_[i].F, volume_ratio(now_[i])) <= c_.rho0 * limit * limit))
        culprit = std::min(culprit, s_.id[i]);
  });
  throw NumericalError(
      this->step_, this->time_, culprit, "deformation",
      fmt::format("particle {} is crushed or turned inside out: waves in it are more than {:g} "
                  "times as fast as at the start, or its deformation is not a number",
                  culprit, greatest_wave_ratio));
}

/// U* = U + Δt U̇(U), U** = U* + Δt U̇(U*), then the mean of U and U**.               [Lee2016] Eq. 43
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::step() {
  const double dt = step_size();
  if (contact_.prepare(s_, vmax_ * dt)) this->show_contacts_to_probes();
  start_ = now_;
  for (int i = 0; i < s_.size(); ++i) Z_[i] = now_[i].x;
  Base::set_outside(dt, this->time_ + dt);
  find_rates(Z_, dt);
  rate_of_start_ = rate_;
  predict(dt);
  project_on_boundary();
  // both momenta are kept by stages that sum to zero about x at the start and at the end of the step
  for (int i = 0; i < s_.size(); ++i) Z_[i] = start_[i].x + (0.5 * dt) * (start_[i].v + now_[i].v);
  find_rates(Z_, dt);
  Base::set_greatest_speed(correct(dt));
  project_on_boundary();
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) {
    now_[i].v = s_.v[i];
    now_[i].x += (0.5 * dt) * change;
    s_.x[i] = now_[i].x;
  });
  Base::finish_step(dt);
}
inline constexpr TermInfo tl_mixed_time_info{"time", "TVD Runge–Kutta, two stages", "[Lee2016] Eq. 43",
                                             "families/tl_mixed/solver.hpp:step",
                                             "mixed: a ring and a disc that collide"};

/// The right-hand sides at the present unknowns.                             [Lee2016] Algorithm 1, steps 4–8
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::find_rates(const std::vector<V>& Z, double dt) {
  set_rows(Z);
  contact_.evaluate(s_, 0.5 * dt);  // the two stages share the step
  gather_pass();
  if constexpr (M.jst) dissipation_pass();
  if (c_.projection != 0) project(Z);
  const bool contact = contact_.acting(), loaded = loads_.active();
  parallel_for(s_.size(), threads_now(), [&](int i) {
    V a = a_[i];
    if (contact) a += (1 / s_.m[i]) * contact_.force(i);
    if (loaded) a += loads_.acceleration(s_, i);
    rate_[i].x = now_[i].v;
    rate_[i].v = s_.mobile[i] * a;
    if constexpr (has_J) rate_[i].J += dissipation_J_[i];
  });
}

template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::set_rows(const std::vector<V>& Z) {
  this->with_laws([&](const auto& law) {
    parallel_for(s_.size(), threads_now(), [&](int i) TAUT_FLATTEN {
      const Unknown& u = now_[i];
      s_.x[i] = Z[i];
      s_.v[i] = u.v;
      velocity_[i] = in_rows(u.v);
      stress_[i] = tile(product(piola(law(i), u), V0_[i] * initial_pairs_.B[i]));
      if constexpr (M.jst) {
        for (int k = 0; k < Dim; ++k) smoothed_[i].value[k] = u.v[k];
        smoothed_[i].value[Dim] = u.J;
      }
    });
  });
}

/// dF/dt, dJ/dt, dH/dt, internal force and L[U].
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::gather_pass() {
  parallel_for(s_.size(), threads_now(), [&](int i) TAUT_FLATTEN {
    const Mat grad_v = product(matrix(initial_pairs_.difference_sum(velocity_, i)), initial_pairs_.B[i]);
    rate_[i].F = grad_v;
    if constexpr (has_J) rate_[i].J = contraction(cofactors(now_[i]), grad_v);
    if constexpr (has_H) rate_[i].H = tensor_cross(now_[i].F, grad_v);
    a_[i] = (1 / s_.m[i]) * initial_pairs_.pair_sum(stress_, i);
    if constexpr (M.jst) once_[i].value = laplacian_sum(initial_pairs_, laplacian_, smoothed_, i);
  });
}
inline constexpr TermInfo volume_ratio_info{
    "volume ratio", "dJ/dt = H : Σ_j (v_j − v_i) ⊗ k_ij B_i, H = cof F", "[Lee2016] Eq. 33c",
    "families/tl_mixed/solver.hpp:gather_pass", "mixed: a ring and a disc that collide"};
inline constexpr TermInfo cofactor_info{
    "cofactor", "dH/dt = F ⨯ Σ_j (v_j − v_i) ⊗ k_ij B_i; H = cof F in 2D", "[Lee2016] Eq. 33b",
    "families/tl_mixed/solver.hpp:gather_pass",
    "mixed: in 3D a block and a ball that collide, and a clamped block hit on its clamp"};

/// D(U) = c_p dp ε₂ L[U] − c_p dp³ ε₄ L*[L[U]] of the velocity and of J.                [Lee2016] Eq. 35–38
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::dissipation_pass() {
  const double rate = Base::wave_speed() / c_.dp;
  parallel_for(s_.size(), threads_now(), [&](int i) TAUT_FLATTEN {
    const Pack twice = weighted_sum(initial_pairs_, outer_, laplacian_, once_, i);
    for (int k = 0; k < Dim; ++k) a_[i][k] += rate * (c_.eps_v2 * once_[i].value[k] - c_.eps_v4 * twice[k]);
    dissipation_J_[i] = rate * (c_.eps_J2 * once_[i].value[Dim] - c_.eps_J4 * twice[Dim]);
  });
}

/// Of each body: the sum of the accelerations and of their moments about Z comes to 0 (Eq. 45–49), and that
/// of the dissipation of J (Eq. 51).
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::project(const std::vector<V>& Z) {
  for (std::size_t body = 0; body + 1 < initial_.first.size(); ++body) {
    const int first = initial_.first[body], last = initial_.first[body + 1];
    project_on_momenta(a_, Z, V0_, first, last, c_.projection);
    if constexpr (has_J) {
      double sum = 0, volume = 0;
      for (int i = first; i < last; ++i) sum += V0_[i] * dissipation_J_[i], volume += V0_[i];
      for (int i = first; i < last; ++i) dissipation_J_[i] -= c_.projection * sum / volume;
    }
  }
}

template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::add(Unknown& u, double dt, const Unknown& rate) {
  u.x += dt * rate.x;
  u.v += dt * rate.v;
  u.F = combination(1.0, u.F, dt, rate.F);
  if constexpr (has_J) u.J += dt * rate.J;
  if constexpr (has_H) u.H = combination(1.0, u.H, dt, rate.H);
}

/// The first stage. Driven particles have the velocity of the end of the step.
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::predict(double dt) {
  const bool driven = drives_.active();
  parallel_for(s_.size(), threads_now(), [&](int i) {
    Unknown& u = now_[i];
    add(u, dt, rate_[i]);
    if (driven && drives_.moves(s_.id[i]))
      u.v = drives_.velocity(s_.id[i]);
    else
      guides_.hold(s_.id[i], u.v);
  });
}

/// Of each body that is held, guided or driven somewhere. What it adds to the energy is not counted as work.
///                                                                               [Lee2016] Algorithm 1, step 9
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::project_on_boundary() {
  if (c_.boundary_projection == 0) return;
  std::vector<unsigned char> axes(s_.size());
  for (int i = 0; i < s_.size(); ++i) {
    const int id = s_.id[i];
    if (initial_.held[id] || drives_.moves(id))
      axes[i] = (1 << Dim) - 1;
    else if (guides_.active())
      axes[i] = initial_.guided[id];
  }
  boundary_.prescribe(std::move(axes), initial_pairs_, X_, V0_, s_.m, initial_.first, c_.h);
  const auto given = [&](int i) { return drives_.moves(s_.id[i]) ? drives_.velocity(s_.id[i]) : V{}; };
  boundary_.project([&](int i) -> V& { return now_[i].v; }, given, [&](int i) -> V& { return now_[i].x; });
  for (int i = 0; i < s_.size(); ++i) s_.v[i] = now_[i].v;
}

/// The mean of start and second stage, U + Δt/2 (U̇ + U̇*). The greatest v², m²/s².
template <const Formulation& M, int Dim>
double TlMixed<M, Dim>::correct(double dt) {
  const bool driven = drives_.active(), loaded = loads_.active();
  return parallel_max(s_.size(), threads_now(), [&](int i) {
    const Unknown &r = rate_of_start_[i], &q = rate_[i];
    Unknown u = start_[i];
    s_.v[i] = u.v;
    u.x += (0.5 * dt) * (r.x + q.x);
    u.v += (0.5 * dt) * (r.v + q.v);
    u.F = combination(1.0, u.F, 0.5 * dt, combination(1.0, r.F, 1.0, q.F));
    if constexpr (has_J) u.J += 0.5 * dt * (r.J + q.J);
    if constexpr (has_H) u.H = combination(1.0, u.H, 0.5 * dt, combination(1.0, r.H, 1.0, q.H));
    if (driven && drives_.moves(s_.id[i])) {
      drives_.replace(s_, i, u.v);
    } else {
      guides_.hold(s_.id[i], u.v);
      if (loaded) loads_.count(s_, i, dt, 0.5 * (s_.v[i] + u.v));
    }
    now_[i] = u;
    s_.x[i] = u.x;
    s_.v[i] = u.v;
    return dot(u.v, u.v);
  });
}

template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::take_snapshot() {
  Base::begin_snapshot();
  parallel_for(s_.size(), threads_now(), [&](int i) { Base::store(i, now_[i].F, volume_ratio(now_[i])); });
}

}  // namespace taut::inline TAUT_ISA
