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
      : Base(input), displacement_(s_.size()), stress_(s_.size()), F_(s_.size()) {
    this->record();
  }

  void step();

 private:
  using Base = InitialPairSolver<TlDisplacement<M, Dim>, M, Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::threads_now, Base::vmax_, Base::initial_pairs_, Base::V0_,
      Base::X_;
  using typename Base::Mat;
  using typename Base::V;

  void deformation_pass();
  double force_pass(double dt);
  void take_snapshot() override;

  std::vector<Tile<Dim>> displacement_;  // u = x − X, in rows
  std::vector<Tile<Dim>> stress_;        // V P B
  std::vector<Mat> F_;
};

template <const Formulation& M, int Dim>
void TlDisplacement<M, Dim>::step() {
  const double dt = Base::step_size();
  if (contact_.prepare(s_, vmax_ * dt)) this->show_contacts_to_probes();
  parallel_for(s_.size(), threads_now(), [&](int i) {
    s_.x[i] += (0.5 * dt) * s_.v[i];
    displacement_[i] = in_rows(s_.x[i] - X_[i]);
  });
  contact_.evaluate(s_, dt);
  deformation_pass();
  Base::set_greatest_speed(force_pass(dt));
  Base::stop_approach(0.5 * dt, [&](int i, const V& change) { s_.x[i] += (0.5 * dt) * change; });
  Base::finish_step(dt);
}
inline constexpr TermInfo tl_displacement_time_info{
    "time", "position Verlet, one step", "[Zhang2020] Eq. 10, 11", "families/tl_displacement/solver.hpp:step",
    "total Lagrangian: a ring and a disc that collide"};

/// F = I + ∇u and P(F) of every particle.
template <const Formulation& M, int Dim>
void TlDisplacement<M, Dim>::deformation_pass() {
  this->with_laws([&](const auto& law) {
    parallel_for(s_.size(), threads_now(), [&](int i) {
      Mat F = product(matrix(initial_pairs_.difference_sum(displacement_, i)), initial_pairs_.B[i]);
      for (int k = 0; k < Dim; ++k) F(k, k) += 1;
      F_[i] = F;
      stress_[i] = tile(product(law(i).piola(F, determinant(F)), V0_[i] * initial_pairs_.B[i]));
    });
  });
}

/// Internal and contact force; then v and the second half of x. The greatest v², m²/s².
template <const Formulation& M, int Dim>
double TlDisplacement<M, Dim>::force_pass(double dt) {
  const typename Base::Kick kick(*this, dt, this->time_ + dt);
  return parallel_max(s_.size(), threads_now(), [&](int i) {
    const V v = kick.by_force(i, initial_pairs_.pair_sum(stress_, i));
    s_.x[i] += (0.5 * dt) * v;
    return dot(v, v);
  });
}

template <const Formulation& M, int Dim>
void TlDisplacement<M, Dim>::take_snapshot() {
  parallel_for(s_.size(), threads_now(), [&](int i) { displacement_[i] = in_rows(s_.x[i] - X_[i]); });
  deformation_pass();
  Base::begin_snapshot();
  parallel_for(s_.size(), threads_now(), [&](int i) { Base::store(i, F_[i], determinant(F_[i])); });
}

}  // namespace taut::inline TAUT_ISA
