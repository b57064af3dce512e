#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/archive.hpp"
#include "engine/core/columns.hpp"
#include "engine/core/team_size.hpp"
#include "engine/methods/constants.hpp"
#include "engine/scene/initial_particles.hpp"
#include "engine/solver/contact/contact.hpp"
#include "engine/solver/drives.hpp"
#include "engine/solver/loads.hpp"
#include "engine/solver/probes.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/solver/state.hpp"

namespace taut::inline TAUT_ISA {

/// A particle that is faster than its body by more than this multiple of the sound speed: the run has diverged, and
/// steps would shrink without end.
inline constexpr double greatest_mach_number = 10;
/// The same of a whole body, whose steps are shorter as many times.
inline constexpr double greatest_mach_number_of_bodies = 1000;
/// No run gets as far; a state that says so is damaged.
inline constexpr long most_steps = 1L << 53;

/// What every solver has, whatever it does in a step: particles, what acts on them from outside, probes.
template <int Dim>
class SolverParts : public Simulation, protected ProbeSource<Dim> {
 protected:
  using V = Vec<double, Dim>;

  /// Particles in the order of creation, where they were laid.
  SolverParts(const SolverInput& input, double support);

  /// Puts the particles where they start; a constructor calls it once it has what it needs of the reference
  /// configuration.
  void go_to_start() {
    if (initial_.start.empty()) return;
    for (int i = 0; i < s_.size(); ++i)
      for (int k = 0; k < Dim; ++k) s_.x[i][k] = initial_.start[s_.id[i]][k];
  }

  /// `by_speed`, s, or the one step that the settings ask for.
  /// Shorter where a contact that has stiffened would be the fastest motion.
  double fixed_or(double by_speed) const {
    constexpr double spare = 1.5;
    return c_.step > 0 ? c_.step : by_speed / std::sqrt(std::max(1.0, contact_.stiffening() / spare));
  }
  /// s, [Zhang2024] Eq. 22, with c0 wherever shear is as soft as in the papers
  double step_size() const { return fixed_or(c_.cfl * c_.h / (c_.step_speed + vmax_)); }
  int threads_now() const { return stepping_ ? team_.threads() : threads_; }

  void finish_step(double dt) {
    time_ += dt;
    ++step_;
  }
  /// Takes the greatest v² of a step; NumericalError if it is out of all bounds.
  void set_greatest_speed(double v2) {
    vmax_ = std::sqrt(v2);
    refuse_divergence();
  }
  void refuse_divergence() const {
    if (!is_within_bounds(vmax_)) refuse_speeds();
  }

  /// Once in each step of `dt`, before `act_from_outside`: `t` is where in time the new velocities stand.
  void set_outside(double dt, double t) {
    drives_.set_time(t);
    loads_.set_time(t - 0.5 * dt);
    if (reactions_.active()) reactions_.begin(s_.v, dt);
  }
  /// What loads, gravity, damping, guides and drives make of `v`, the new velocity of particle i without
  /// them.
  void act_from_outside(int i, double dt, V& v) {
    if (drives_.moves(s_.id[i])) return drives_.replace(s_, i, v);
    const bool loaded = loads_.active();
    if (loaded) loads_.act(s_, i, dt, v);
    guides_.hold(s_.id[i], v);
    if (loaded) loads_.count(s_, i, dt, 0.5 * (s_.v[i] + v));
  }

  /// Gives particles the velocities of a whole step, from what acts inside a body, contact and what acts from
  /// outside.
  class Kick {
   public:
    /// `t` is where in time the new velocities stand.
    Kick(SolverParts& solver, double dt, double t)
        : solver_(solver), dt_(dt), contact_(solver.contact_.acting()), watched_(solver.reactions_.active()) {
      solver.set_outside(dt, t);
      outside_ = solver.drives_.active() || solver.loads_.active() || solver.guides_.active();
    }

    [[gnu::always_inline]] const V& by_acceleration(int i, V a) const {
      State<Dim>& s = solver_.s_;
      if (contact_) a += (1 / s.m[i]) * solver_.contact_.force(i);
      if (watched_) solver_.reactions_.add(i, (dt_ * s.m[i]) * a);
      V v = s.v[i];
      v += (dt_ * s.mobile[i]) * a;
      return take(i, v);
    }
    /// Adds the forces of contact to those of four particles from `first` on; at the end there may be fewer.
    [[gnu::always_inline]] void add_contact(int first, Vec<Pack, Dim>& force) const {
      if (!contact_) return;
      const double* const of_contact = &solver_.contact_.force(first)[0];
      Pack rows[Dim], columns[Dim];
      for (int k = 0, left = Dim * (solver_.s_.size() - first); k < Dim; ++k, left -= lanes)
        rows[k] =
            left >= lanes ? taut::load(of_contact + lanes * k) : taut::load(of_contact + lanes * k, left);
      separate(rows, columns);
      for (int k = 0; k < Dim; ++k) force[k] += columns[k];
    }
    /// Probes ask for reactions: before the particles move `note` is told what acts on them within their
    /// body. It is a pass of its own, so that the others have no code for it.
    bool watched() const { return watched_; }
    void note(int first, Vec<Pack, Dim> force) const {
      if (contact_) force += four_of(&solver_.contact_.force(first), solver_.s_.size() - first);
      for (int lane = 0; lane < std::min(lanes, solver_.s_.size() - first); ++lane)
        solver_.reactions_.add(first + lane, dt_ * lane_of(force, lane));
    }
    /// Four particles at once, by the change of v that all forces make together; x follows the new v for
    /// `after`, s. Gives v² of each, m²/s². At the end there may be fewer.
    [[gnu::always_inline]] Pack by_changes(int first, const Pack (&change)[Dim], double after) const {
      State<Dim>& s = solver_.s_;
      Pack rows[Dim], columns[Dim], v2{};
      if (outside_ || first + lanes > s.size()) {
        for (int lane = 0; lane < lanes && first + lane < s.size(); ++lane) {
          V v = s.v[first + lane];
          for (int k = 0; k < Dim; ++k) v[k] += change[k][lane];
          s.x[first + lane] += after * take(first + lane, v);
          v2[lane] = dot(s.v[first + lane], s.v[first + lane]);
        }
        return v2;
      }
      interleave(change, rows);
      double* const x_at = reinterpret_cast<double*>(&s.x[first]);  // of `lanes` particles, row by row
      double* const v_at = reinterpret_cast<double*>(&s.v[first]);
#pragma GCC unroll 3
      for (int k = 0; k < Dim; ++k) {
        rows[k] += taut::load(v_at + lanes * k);
        taut::store(rows[k], v_at + lanes * k);
        taut::store(taut::load(x_at + lanes * k) + after * rows[k], x_at + lanes * k);
      }
      separate(rows, columns);
      for (const Pack& v : columns) v2 += v * v;
      return v2;
    }
    /// The four particles from `first` on, or as many as there are, with `mobility` = mobile/m, 1/kg.
    [[gnu::always_inline]] Vec<Pack, Dim> by_forces(int first, const Pack& mobility,
                                                    Vec<Pack, Dim> force) const {
      State<Dim>& s = solver_.s_;
      if (contact_) force += four_of(&solver_.contact_.force(first), s.size() - first);
      Vec<Pack, Dim> v = four_of(s.v, first);
      v += (dt_ * mobility) * force;
      for (int lane = 0; outside_ && lane < std::min(lanes, s.size() - first); ++lane) {
        V own = lane_of(v, lane);
        solver_.act_from_outside(first + lane, dt_, own);
        set_lane(v, lane, own);
      }
      put_four(v, s.v, first);
      return v;
    }

   private:
    [[gnu::always_inline]] const V& take(int i, V v) const {
      if (outside_) solver_.act_from_outside(i, dt_, v);
      return solver_.s_.v[i] = v;
    }

    SolverParts& solver_;
    double dt_;  // s
    bool contact_, watched_, outside_;
  };

  /// The new velocities of particles that meet those of other bodies, under the impulse law: each is changed
  /// so that the approach ends, and `follow(i, change)` corrects what was made of it. Positions have followed
  /// the new velocities for `gone`, s, already.
  template <class Follow>
  void stop_approach(double gone, const Follow& follow) {
    const auto inverse_mass = [&](int i) { return drives_.moves(s_.id[i]) ? 0 : s_.mobile[i] / s_.m[i]; };
    contact_.stop_approach(s_, gone, inverse_mass, [&](int i, const V& impulse) {
      if (reactions_.active()) reactions_.add(i, impulse);
      V v = s_.v[i];
      v += (s_.mobile[i] / s_.m[i]) * impulse;
      if (!drives_.moves(s_.id[i])) guides_.hold(s_.id[i], v);
      drives_.replace(s_, i, v);
      const V change = v - s_.v[i];
      s_.v[i] = v;
      follow(i, change);
    });
  }

  /// Of methods that search for nothing but contacts.
  void show_contacts_to_probes() {
    s_.neighbors = contact_.neighbors(s_.size());
    recorder_.rebuilt(s_, s_.neighbors, Contact<Dim>::reach * c_.dp);
  }

  ContactsOfFaces<Dim>* faces() final { return contact_.faces(); }
  V reaction(int i) final;
  V contact_force(const Probe& probe, double dt) override {
    return (1 / dt) * contact_.impulse(probe.bodies[0], probe.wall < 0 ? probe.bodies[1] : -1, probe.wall);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive.match(initial_.size());
    archive.match(static_cast<int>(recorder_.size()));
    archive(s_);
    archive.check("a particle", [&] { return are_of_this_scene(); });
    contact_.serialize(archive, s_.size());
    archive(drives_, loads_, recorder_, time_, step_, vmax_, series_, pairs_);
    archive.check("a value of a particle", [&] { return recorder_.follows(s_) && are_numbers(); });
    archive.check("the time, the step or a series", [&] {
      const bool counted = recorder_.size() == 0 ? series_.time.empty()
                                                 : std::cmp_equal(series_.time.size() - 1, step_) &&
                                                       series_.time.back() == time_;
      return std::isfinite(time_) && time_ >= 0 && step_ >= 0 && step_ < most_steps && counted &&
             (is_within_bounds(vmax_) || (vmax_ > 0 && vmax_ <= 2 * fastest()));
    });
  }
  /// Time and sizes of the snapshot; then every particle is to be stored.
  void begin_snapshot();
  void store(int i, double rho, double p, const Sym<double, Dim>& s, double s_zz);

  const RunState& run_state() const final { return run_; }

  RunState run_;
  double& time_ = run_.time;
  long& step_ = run_.steps;
  Series& series_ = run_.series;
  long& pairs_ = run_.pairs;
  double& support_ = run_.support;
  bool& keeps_neighbors_ = run_.keeps_neighbors;
  double& lawful_stretch_ = run_.lawful_stretch;
  int& threads_ = run_.threads;
  Constants c_;
  InitialParticles initial_;
  State<Dim> s_;
  Contact<Dim> contact_;
  Drives<Dim> drives_;
  Guides<Dim> guides_;
  Loads<Dim> loads_;
  Reactions<Dim> reactions_;
  ProbeRecorder<Dim> recorder_;
  bool stepping_ = false;  // the set-up takes all threads
  TeamSize team_;
  double vmax_ = 0;  // m/s

 private:
  /// m/s; not a number is not.
  bool is_within_bounds(double speed) const { return speed >= 0 && speed <= greatest_mach_number * c_.c0; }
  void refuse_speeds() const;
  double fastest() const;  // m/s
  bool are_of_this_scene() const;
  bool are_numbers() const;
};

}  // namespace taut::inline TAUT_ISA
