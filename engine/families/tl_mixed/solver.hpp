#pragma once

#include <algorithm>
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
/// ratio J and cofactor H of F as unknowns of equations of their own, with Jameson–Schmidt–Turkel
/// dissipation. [Lee2016] Algorithm 1. The momentum goes as the velocity p/ρ0. In plane strain H is linear in
/// F, and its equation says nothing that that of F does not: there {p, F, H, J} runs as {p, F, J}.
///
/// Differs from the paper in the biharmonic term, L*[L[U]] with the adjoint of L in place of L[L[U]] (Eq.
/// 37b). L is not symmetric at a surface, where its square may feed what it is to damp: with it `pfj-jst`
/// loses the bending column at Poisson's ratio 0.499 for ε of J from 1/32 on, at any time step. The adjoint
/// takes from every field (−Σ V |L[U]|²) and is the same inside. The constant `adjoint` = 0 gives the printed
/// form. Boundary conditions are set on the particles themselves (its step 8), and where the kernel looks
/// (step 9, "usually disregarded") with `boundary_projection` = 1. Forces of contact, which it has not, act
/// outside the projection and are taken at its Z, about which central forces have no moment; so do loads. Of
/// the dissipation and the internal force the sum is projected, which is the same as each of them (Eq. 49).
template <const Formulation& M, int Dim>
class TlMixed final : public InitialPairSolver<TlMixed<M, Dim>, M, Dim> {
 public:
  explicit TlMixed(const SolverInput& input);

  double step_size() const;
  void step(double dt);
  void prepare_to_show() {}
  void show(int group);
  template <class Archive>
  void serialize(Archive& archive) {
    Base::serialize(archive);
    archive.fixed(strain_);
  }

 private:
  using Base = InitialPairSolver<TlMixed<M, Dim>, M, Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::drives_, Base::guides_, Base::loads_, Base::reactions_,
      Base::threads_now, Base::vmax_;
  using Base::groups, Base::initial_, Base::initial_pairs_, Base::sites_, Base::V0_, Base::X_;
  using Mat = taut::Mat<Pack, Dim>;
  using typename Base::V;

  static constexpr bool has_J = follows_volume_ratio(M);
  static constexpr bool has_H = M.unknowns == Unknowns::v_F_H_J && Dim == 3;
  static constexpr int fields = Dim + has_J;  // that the dissipation acts on
  struct None {};

  /// Unknowns of four particles beside places and velocities, which are in the state.
  struct Strain {
    Mat F;
    Pack J;  // where it is one
    [[no_unique_address]] std::conditional_t<has_H, Mat, None> H{};
  };

  static Pack volume_ratio(const Strain& u) { return has_J ? u.J : determinant(u.F); }
  static Mat cofactors(const Strain& u) {
    if constexpr (has_H)
      return u.H;
    else
      return cofactor(u.F);
  }
  template <class L>
  static Pack stiffness(const L& law, const Strain& u) {
    return law.stiffness_bound(u.F, volume_ratio(u));
  }
  template <class L>
  static Mat piola(const L& law, const Strain& u) {
    if constexpr (has_H)
      return law.piola(u.F, u.H, u.J);
    else
      return law.piola(u.F, volume_ratio(u));
  }

  double greatest_step_of_dissipation() const;
  [[noreturn]] void crushed() const;
  void set_start_gradients();
  void find_rates(double dt);
  void set_columns();
  void gather_pass();
  void dissipation_pass();
  void project();
  void project_on_boundary(double ahead);
  Vec<Pack, Dim> acceleration(int group);
  [[gnu::noinline]] void watch(int group, Vec<Pack, Dim> a);
  void predict(double dt);
  double correct(double dt);
  void stop_approach(double dt);
  void hold(int i, double dt, Vec<Pack, Dim>& of_four);

  PairLanes<Dim, M.jst ? Dim + 2 : Dim> pair_lanes_;  // k_ij; for the dissipation w_ij dp² and that of L*
  Columns<fields> flow_;                              // v, m/s, and J
  Columns<Dim * Dim> stress_;                         // V P B, row by row
  Columns<fields> once_;                              // dp² L of (v, J)
  std::vector<Strain> strain_, start_;                // at the stage and at the start of the step
  std::vector<Strain> rate_;                          // at the stage
  std::vector<V> v_start_;                            // m/s
  Columns<Dim> a_, a_start_;                          // without contact and loads; of all at the start, m/s²
  Columns<1> dissipation_J_;                          // 1/s
  double dissipation_limit_ = std::numeric_limits<double>::infinity();  // s, of the step
  PrescribedBoundary<Kernel<M.kernel>, Dim> boundary_;
};

template <const Formulation& M, int Dim>
TlMixed<M, Dim>::TlMixed(const SolverInput& input) : Base(input), v_start_(s_.size()) {
  if constexpr (M.jst) {
    const std::vector<double> w =
        corrected_laplacian<Kernel<M.kernel>>(initial_pairs_, X_, V0_, c_.h, c_.dp * c_.dp, input.threads);
    pair_lanes_ = with_laplacian(initial_pairs_, w, V0_, c_.adjoint, input.threads);
    once_.resize(s_.size());
    dissipation_limit_ = greatest_step_of_dissipation();
  } else {
    pair_lanes_ = {initial_pairs_, input.threads, [&](int p) { return initial_pairs_.k[p]; }};
  }
  if (c_.boundary_projection == 0)
    initial_pairs_ = {};
  else
    initial_pairs_.k = std::vector<V>();  // {} would keep the room
  flow_.resize(s_.size());
  stress_.resize(s_.size());
  a_.resize(s_.size() + lanes), a_start_.resize(s_.size());  // packs of a body may begin anywhere
  dissipation_J_.resize(s_.size() + lanes);
  Mat one{};
  for (int k = 0; k < Dim; ++k) one(k, k) = filled<Pack>(1);
  strain_.assign(groups(), Strain{one, filled<Pack>(1)});
  if constexpr (has_H)
    for (Strain& u : strain_) u.H = one;
  if (!initial_.start.empty()) set_start_gradients();
  start_ = rate_ = strain_;
  if (c_.boundary_projection != 0 && reactions_.active())
    throw SceneError("probe",
                     "with boundary_projection = 1 what is held acts on all around it, and no probe of "
                     "kind 'reaction' can tell how much; run with method.boundary_projection=0");
  this->record();
}

/// Of bodies that start displaced: F is what the kernel sees of their places, as its rate is what it sees of
/// their velocities, J its determinant and H its cofactor.
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::set_start_gradients() {
  for (int i = 0; i < s_.size(); ++i)
    for (int k = 0; k < Dim; ++k) flow_[k][i] = s_.x[i][k] - X_[i][k];
  for (int group = 0; group < groups(); ++group) {
    Strain& u = strain_[group];
    u.F += product(pair_lanes_.difference_sum(flow_, group), sites_[group].B);
    if constexpr (has_J) u.J = determinant(u.F);
    if constexpr (has_H) u.H = cofactor(u.F);
  }
}

/// The step that two Runge–Kutta stages bear of the dissipation, 2 over its greatest rate, less a tenth for
/// the waves that it damps. The paper's step is below it but at the edges of bodies of few layers.
template <const Formulation& M, int Dim>
double TlMixed<M, Dim>::greatest_step_of_dissipation() const {
  const double square = biharmonic_spectral_radius(pair_lanes_, s_.size(), this->threads_),
               once = std::sqrt(square);
  const double rate = std::max(c_.eps_v2 * once + c_.eps_v4 * square, c_.eps_J2 * once + c_.eps_J4 * square);
  return 0.9 * 2 * c_.dp / (Base::wave_speed() * rate);
}

/// In 3D α_CFL h/c_p with the fastest wave through the strained bodies, seen from their start: waves along a
/// direction that is pressed together cross more of the initial spacings.       [Lee2016] Eq. 44, Alg. 1,
/// step 2 Differs from the paper, which has dp for h: at 0.3 dp/c_p zigzags at free faces grow where
/// particles are in the middle of cells (limit 0.25; 0.39 on the boundary); and in the plane, where the
/// greatest speed stands for how fast bodies are strained.
template <const Formulation& M, int Dim>
double TlMixed<M, Dim>::step_size() const {
  if constexpr (Dim == 2) {
    return this->fixed_or(std::min(Base::step_size(), dissipation_limit_));
  } else {
    const double stiffest = this->with_laws([&](const auto& laws) {
      return parallel_max(groups(), threads_now(), [&](int group) {
        return greatest(laws(group, [&](const auto& law) { return stiffness(law, strain_[group]); }));
      });
    });
    const double fastest = std::sqrt(stiffest / c_.rho0);
    if (!(fastest <= greatest_wave_ratio * Base::wave_speed())) crushed();
    const double at_least = Base::wave_speed();  // where a body is softer everywhere, it need not stay so
    return this->fixed_or(std::min(c_.cfl * c_.h / std::max(fastest, at_least), dissipation_limit_));
  }
}

/// Names the first particle in the order of creation in which waves are too fast.
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::crushed() const {
  const double limit = greatest_wave_ratio * Base::wave_speed();
  int culprit = s_.size();  // id
  this->with_laws([&](const auto& laws) {
    for (int group = 0; group < groups(); ++group) {
      const Pack bound = laws(group, [&](const auto& law) { return stiffness(law, strain_[group]); });
      Base::each_of(group, [&](int i) {
        if (!(bound[i % lanes] <= c_.rho0 * limit * limit)) culprit = std::min(culprit, s_.id[i]);
      });
    }
  });
  throw NumericalError(
      this->step_, this->time_, culprit, "deformation",
      fmt::format("particle {} is crushed or turned inside out: waves in it are more than {:g} "
                  "times as fast as at the start, or its deformation is not a number",
                  culprit, greatest_wave_ratio));
}

/// U* = U + Δt U̇(U), U** = U* + Δt U̇(U*), then the mean of U and U**.               [Lee2016] Eq. 43
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::step(double dt) {
  if (contact_.prepare(s_, vmax_ * dt)) this->show_contacts_to_probes();
  Base::set_outside(dt, this->time_ + dt);
  find_rates(dt);
  predict(dt);
  project_on_boundary(dt);
  // both momenta are kept by stages that sum to zero about x at the start and at the end of the step; what is held stays,
  // whatever velocity the projection on the boundary gives it for those around to see
  parallel_for(s_.size(), threads_now(),
               [&](int i) { s_.x[i] += (0.5 * dt * s_.mobile[i]) * (v_start_[i] + s_.v[i]); });
  find_rates(dt);
  Base::set_greatest_speed(correct(dt));
  project_on_boundary(0);
  stop_approach(dt);
  Base::finish_step(dt);
}
inline constexpr TermInfo tl_mixed_time_info{"time", "TVD Runge–Kutta, two stages", "[Lee2016] Eq. 43",
                                             "families/tl_mixed/solver.hpp:step",
                                             "mixed: a ring and a disc that collide"};

/// The right-hand sides at the present unknowns, but for contact and loads.  [Lee2016] Algorithm 1, steps 4–8
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::find_rates(double dt) {
  set_columns();
  contact_.evaluate(s_, 0.5 * dt, threads_now());  // the two stages share the step
  gather_pass();
  if constexpr (M.jst) dissipation_pass();
  if (c_.projection != 0) project();
}

template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::set_columns() {
  this->with_laws([&](const auto& laws) {
    parallel_pass(groups(), threads_now(), [&](int group) {
      const Strain& u = strain_[group];
      const Vec<Pack, Dim> v = four_of(s_.v, lanes * group);
      for (int k = 0; k < Dim; ++k) store(v[k], flow_[k] + lanes * group);
      if constexpr (has_J) store(u.J, flow_[Dim] + lanes * group);
      const Mat P = laws(group, [&](const auto& law) { return piola(law, u); });
      put(product(P, sites_[group].V0 * sites_[group].B), stress_, lanes * group);
    });
  });
}

/// dF/dt, dJ/dt, dH/dt, internal force and L[U].
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::gather_pass() {
  parallel_pass(groups(), threads_now(), [&](int group) {
    Mat sum;
    if constexpr (M.jst) {
      const auto both = differences_and_laplacian(pair_lanes_, flow_, group);
      sum = both.differences;
      put(both.laplacian, once_, lanes * group);
    } else {
      sum = pair_lanes_.difference_sum(flow_, group);
    }
    const Mat grad_v = product(sum, sites_[group].B);
    const Strain& u = strain_[group];
    rate_[group].F = grad_v;
    if constexpr (has_J) rate_[group].J = contraction(cofactors(u), grad_v);
    if constexpr (has_H) rate_[group].H = tensor_cross(u.F, grad_v);
    put(sites_[group].per_m * pair_lanes_.pair_sum(stress_, group), a_, lanes * group);
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
  parallel_pass(groups(), threads_now(), [&](int group) {
    const Vec<Pack, fields> once = vector_at<fields>(once_, lanes * group),
                            twice = second_laplacian(pair_lanes_, once_, group);
    Vec<Pack, Dim> a = vector_at<Dim>(a_, lanes * group);
    for (int k = 0; k < Dim; ++k) a[k] += rate * (c_.eps_v2 * once[k] - c_.eps_v4 * twice[k]);
    put(a, a_, lanes * group);
    if constexpr (has_J)
      store(rate * (c_.eps_J2 * once[Dim] - c_.eps_J4 * twice[Dim]), dissipation_J_[0] + lanes * group);
  });
}

/// Of each body: the sum of the accelerations and of their moments about Z comes to 0 (Eq. 45–49), and that
/// of the dissipation of J (Eq. 51).
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::project() {
  for (std::size_t body = 0; body + 1 < initial_.first.size(); ++body) {
    const int first = initial_.first[body], last = initial_.first[body + 1];
    project_on_momenta(a_, s_.x, V0_, first, last, c_.projection);
    if constexpr (has_J) subtract_mean(dissipation_J_, V0_, first, last, c_.projection);
  }
}

/// For the probes of reactions: the two stages share the step.
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::watch(int group, Vec<Pack, Dim> a) {
  Base::each_of(group,
                [&](int i) { reactions_.add(i, (0.5 * reactions_.dt() * s_.m[i]) * lane_of(a, i % lanes)); });
}

/// dv/dt
template <const Formulation& M, int Dim>
Vec<Pack, Dim> TlMixed<M, Dim>::acceleration(int group) {
  const int first = lanes * group;
  Vec<Pack, Dim> a = vector_at<Dim>(a_, first);
  if (contact_.acting()) a += sites_[group].per_m * four_of(&contact_.force(first), s_.size() - first);
  if (reactions_.active()) watch(group, a);
  if (loads_.active())
    Base::each_of(group, [&](int i) {
      if (drives_.moves(s_.id[i])) return;  // it does not feel them, and they do no work on it
      set_lane(a, i % lanes, lane_of(a, i % lanes) + loads_.acceleration(s_, i));
    });
  return sites_[group].mobile * a;
}

/// The first stage. Driven particles have the velocity of the end of the step.
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::predict(double dt) {
  const bool steered = drives_.active() || guides_.active();
  parallel_pass(groups(), threads_now(), [&](int group) {
    const int first = lanes * group;
    Strain& u = strain_[group];
    const Strain& rate = rate_[group];
    start_[group] = u;
    u.F = combination(1.0, u.F, dt, rate.F);
    if constexpr (has_J) u.J += dt * (rate.J + load(dissipation_J_[0] + first));
    if constexpr (has_H) u.H = combination(1.0, u.H, dt, rate.H);
    const Vec<Pack, Dim> a = acceleration(group), v = four_of(s_.v, first);
    put(a, a_start_, first);
    put_four(v, v_start_, first);
    put_four(v + filled<Pack>(dt) * a, s_.v, first);
    if (steered)
      Base::each_of(group, [&](int i) {
        if (drives_.moves(s_.id[i]))
          s_.v[i] = drives_.velocity(s_.id[i]);
        else
          guides_.hold(s_.id[i], s_.v[i]);
      });
  });
}

/// Of each body that is held, guided or driven somewhere. What it adds to the energy is not counted as work.
///                                                                               [Lee2016] Algorithm 1, step 9
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::project_on_boundary(double ahead) {
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
  boundary_.project([&](int i) -> V& { return s_.v[i]; }, given,
                    [&](int i) { return s_.x[i] + ahead * v_start_[i]; });
}

/// The mean of start and second stage, ½ (U + U* + Δt U̇(U*)). The greatest v², m²/s².
template <const Formulation& M, int Dim>
double TlMixed<M, Dim>::correct(double dt) {
  const bool outside = drives_.active() || guides_.active() || loads_.active();
  return parallel_max(groups(), threads_now(), [&](int group) {
    const int first = lanes * group;
    Strain& u = strain_[group];
    const Strain &start = start_[group], &rate = rate_[group];
    const auto mean = [&](const Mat& U, const Mat& U_star, const Mat& U_rate) {
      return combination(0.5, U + U_star, 0.5 * dt, U_rate);
    };
    u.F = mean(start.F, u.F, rate.F);
    if constexpr (has_J) u.J = 0.5 * (start.J + u.J + dt * (rate.J + load(dissipation_J_[0] + first)));
    if constexpr (has_H) u.H = mean(start.H, u.H, rate.H);
    const Vec<Pack, Dim> a = vector_at<Dim>(a_start_, first) + acceleration(group);
    Vec<Pack, Dim> v = four_of(v_start_, first) + filled<Pack>(0.5 * dt) * a;
    if (outside) Base::each_of(group, [&](int i) { hold(i, dt, v); });
    put_four(v, s_.v, first);
    return greatest(dot(v, v));
  });
}

/// Under the impulse law: positions have followed the mean of the velocities at both ends of the step, and so have
/// their gradients F, with J and H. Left where they were, they would keep a strain that nobody sees.
/// The mean is that of the start and of the first stage, so that who is stopped time and again creeps on by dt²/4 of the
/// difference of the accelerations of both stages a step. To move it back by that too would cost the angular momentum.
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::stop_approach(double dt) {
  bool stopped = false;
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) {
    if (!stopped)
      for (int k = 0; k < Dim; ++k) std::fill_n(flow_[k], flow_.size(), 0.0);
    stopped = true;
    s_.x[i] += (0.5 * dt) * change;
    for (int k = 0; k < Dim; ++k) flow_[k][i] = change[k];
  });
  if (!stopped) return;
  parallel_pass(groups(), threads_now(), [&](int group) {
    const Mat grad_v = product(pair_lanes_.difference_sum(flow_, group), sites_[group].B);
    Strain& u = strain_[group];
    if constexpr (has_J) u.J += (0.5 * dt) * contraction(cofactors(u), grad_v);
    if constexpr (has_H) u.H = combination(1.0, u.H, 0.5 * dt, tensor_cross(u.F, grad_v));
    u.F = combination(1.0, u.F, 0.5 * dt, grad_v);
  });
}

/// What drives and guides make of the velocity that particle i would have at the end of the step, and what
/// they and loads do for it.
template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::hold(int i, double dt, Vec<Pack, Dim>& of_four) {
  V v = lane_of(of_four, i % lanes);
  s_.v[i] = v_start_[i];
  if (drives_.moves(s_.id[i])) {
    drives_.replace(s_, i, v);
  } else {
    guides_.hold(s_.id[i], v);
    if (loads_.active()) loads_.count(s_, i, dt, 0.5 * (s_.v[i] + v));
  }
  set_lane(of_four, i % lanes, v);
}

template <const Formulation& M, int Dim>
void TlMixed<M, Dim>::show(int group) {
  const Strain& u = strain_[group];
  const Pack J = volume_ratio(u);
  Base::each_of(group, [&](int i) { Base::store(i, lane_of(u.F, i % lanes), J[i % lanes]); });
}

}  // namespace taut::inline TAUT_ISA
