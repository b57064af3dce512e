#pragma once

#include <vector>

#include "engine/solver/initial_pair_solver.hpp"

namespace taut::inline TAUT_ISA {

/// Total-Lagrangian methods whose only unknowns are the positions: the deformation gradient comes from them
/// at every step. [Lee2016] Eq. 34, [TranDuc2023] §2.3, [Zhang2020]. The forces are those of an energy,
/// unless the law has none, and time goes in position Verlet steps (the leap-frog of [Zhang2020] Eq. 10, 11
/// with its forces at mid-step), so that the energy has no drift. There is no dissipation.
template <const Formulation& M, int Dim>
class TlDisplacement final : public InitialPairSolver<TlDisplacement<M, Dim>, M, Dim> {
 public:
  explicit TlDisplacement(const SolverInput& input)
      : Base(input), pair_lanes_(initial_pairs_, input.threads, [&](int p) { return initial_pairs_.k[p]; }) {
    initial_pairs_ = {};
    displacement_.resize(s_.size());
    stress_.resize(s_.size());
    this->record();
  }

  void step(double dt);
  void prepare_to_show() { drift(0); }
  void show(int group);

 private:
  using Base = InitialPairSolver<TlDisplacement<M, Dim>, M, Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::threads_now, Base::vmax_, Base::initial_pairs_,
      Base::groups, Base::X_;
  using typename Base::V;

  void drift(double dt);
  Mat<Pack, Dim> deformation(int group) const;
  void stress_pass();
  double force_pass(double dt);

  PairLanes<Dim> pair_lanes_;
  Columns<Dim> displacement_;  // u = x − X, m
  Columns<Dim * Dim> stress_;  // V P B, row by row, N/m^(Dim − 1)
};

template <const Formulation& M, int Dim>
void TlDisplacement<M, Dim>::step(double dt) {
  if (contact_.prepare(s_, vmax_ * dt)) this->show_contacts_to_probes();
  drift(0.5 * dt);
  contact_.evaluate(s_, dt, threads_now());
  stress_pass();
  Base::set_greatest_speed(force_pass(dt));
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) { s_.x[i] += (0.5 * dt) * change; });
  Base::finish_step(dt);
}
inline constexpr TermInfo tl_displacement_time_info{
    "time", "position Verlet, one step", "[Zhang2020] Eq. 10, 11", "families/tl_displacement/solver.hpp:step",
    "total Lagrangian: a ring and a disc that collide"};

/// x moves on, and u with it.
template <const Formulation& M, int Dim>
void TlDisplacement<M, Dim>::drift(double dt) {
  parallel_for(groups(), threads_now(), [&](int group) {
    const int first = lanes * group;
    const Vec<Pack, Dim> x = four_of(s_.x, first) + filled<Pack>(dt) * four_of(s_.v, first);
    put_four(x, s_.x, first);
    put(x - four_of(X_, first), displacement_, first);
  });
}

/// F = I + ∇u
template <const Formulation& M, int Dim>
Mat<Pack, Dim> TlDisplacement<M, Dim>::deformation(int group) const {
  Mat<Pack, Dim> F = product(pair_lanes_.difference_sum(displacement_, group), this->sites_[group].B);
  for (int k = 0; k < Dim; ++k) F(k, k) += 1;
  return F;
}

/// V P(F) B of every particle.
template <const Formulation& M, int Dim>
void TlDisplacement<M, Dim>::stress_pass() {
  this->with_laws([&](const auto& laws) {
    parallel_pass(groups(), threads_now(), [&](int group) {
      const Mat<Pack, Dim> F = deformation(group);
      const Mat<Pack, Dim> P = laws(group, [&](const auto& law) { return law.piola(F, determinant(F)); });
      const auto& site = this->sites_[group];
      put(product(P, site.V0 * site.B), stress_, lanes * group);
    });
  });
}

/// Internal and contact force; then v and the second half of x. The greatest v², m²/s².
template <const Formulation& M, int Dim>
double TlDisplacement<M, Dim>::force_pass(double dt) {
  const typename Base::Kick kick(*this, dt, this->time_ + dt);
  if (kick.watched())
    parallel_for(groups(), threads_now(),
                 [&](int group) { kick.note(lanes * group, pair_lanes_.pair_sum(stress_, group)); });
  return parallel_max(groups(), threads_now(), [&](int group) {
    const int first = lanes * group;
    const auto& site = this->sites_[group];
    const Vec<Pack, Dim> v =
        kick.by_forces(first, site.mobile * site.per_m, pair_lanes_.pair_sum(stress_, group));
    put_four(four_of(s_.x, first) + filled<Pack>(0.5 * dt) * v, s_.x, first);
    return greatest(dot(v, v));
  });
}

template <const Formulation& M, int Dim>
void TlDisplacement<M, Dim>::show(int group) {
  const Mat<Pack, Dim> F = deformation(group);
  Base::each_of(group, [&](int i) {
    const Mat<double, Dim> own = lane_of(F, i % lanes);
    Base::store(i, own, determinant(own));
  });
}

}  // namespace taut::inline TAUT_ISA
