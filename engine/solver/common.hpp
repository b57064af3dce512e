#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/contact/contact.hpp"
#include "engine/core/archive.hpp"
#include "engine/core/team_size.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/methods/constants.hpp"
#include "engine/solver/external.hpp"
#include "engine/solver/kick.hpp"
#include "engine/solver/probes.hpp"
#include "engine/solver/simulation.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// Greatest speed of a particle relative to its body, in c0.
inline constexpr double greatest_mach_number = 10;
/// Greatest speed of any particle, in c0.
inline constexpr double greatest_mach_number_of_bodies = 1000;
/// A saved state with more steps is damaged.
inline constexpr long most_steps = 1L << 53;

template <int Dim>
class Common {
 public:
  using V = Vec<double, Dim>;

  /// `support`: radius of interaction, m.
  Common(const SolverInput& input, double support);

  Constants constants;
  const InitialParticles initial;
  Particles<Dim> particles;
  Contact<Dim> contact;
  External<Dim> external;
  ProbeRecorder<Dim> probes;
  TeamSize team;
  bool stepping = false;  // false during set-up, which uses all threads
  RunState run;
  double vmax = 0;  // m/s

  int size() const { return particles.size(); }
  int threads_now() const { return stepping ? team.threads() : run.threads; }

  /// Call after storing the reference configuration.
  void go_to_start();

  /// Time step in s: the fixed step of the settings, or else `by_speed`, reduced for stiff contact.
  double fixed_or_stable_step(double by_speed) const {
    constexpr double spare = 1.5;
    return constants.step > 0 ? constants.step
                              : by_speed / std::sqrt(std::max(1.0, contact.stiffening() / spare));
  }

  Kick<Dim> kick(double dt, double t);
  /// See Contact::stop_approach. `follow(i, change)` updates data that depend on v.
  template <class Follow>
  void stop_approach(double gone, const Follow& follow) {
    Particles<Dim>& p = particles;
    const auto inverse_mass = [&](int i) {
      V inverse{};
      if (external.drives.moves(p.id[i])) return inverse;
      for (int k = 0; k < Dim; ++k) inverse[k] = p.mobile[i] / p.m[i];
      external.guides.constrain(p.id[i], inverse);
      return inverse;
    };
    contact.stop_approach(p, gone, inverse_mass, [&](int i, const V& impulse) {
      if (external.reactions.active()) external.reactions.add(i, impulse);
      V v = p.v[i];
      v += (p.mobile[i] / p.m[i]) * impulse;
      if (!external.drives.moves(p.id[i])) external.guides.constrain(p.id[i], v);
      external.drives.replace(p, i, v);
      const V change = v - p.v[i];
      p.v[i] = v;
      follow(i, change);
    });
  }

  void finish_step(double dt) {
    run.time += dt;
    ++run.steps;
  }
  /// `v2` in m²/s². Throws NumericalError if a particle has diverged.
  void set_greatest_speed(double v2) {
    vmax = std::sqrt(v2);
    refuse_divergence();
  }
  void refuse_divergence() const {
    if (!is_within_bounds(vmax)) throw_if_diverged();
  }

  void show_contacts_to_probes() {
    probes.rebuilt(particles, contact.neighbors(size()), Contact<Dim>::reach * constants.dp);
  }
  V contact_force(const Probe& probe, double dt) const {
    return (1 / dt) * contact.impulse(probe.bodies[0], probe.wall < 0 ? probe.bodies[1] : -1, probe.wall);
  }

  void begin_motion(Snapshot& out) const;
  void store_motion(Snapshot& out, int i) const;
  void begin_snapshot(Snapshot& out) const;
  /// `rho` in kg/m³; `p`, `s` and `s_zz` (2D only) in Pa.
  void store(Snapshot& out, int i, double rho, double p, const Sym<double, Dim>& s, double s_zz) const;

  template <class Archive, class Method>
  void serialize(Archive& archive, const Method& method) {
    archive.match(initial.size());
    archive.match(static_cast<int>(probes.size()));
    Particles<Dim>& p = particles;
    archive.fixed(p.x, p.v, p.m, p.mobile, p.id, p.body, p.material);
    archive.check("a particle", [&] { return are_of_this_scene(); });
    contact.serialize(archive, size());
    archive(external, probes, run.time, run.steps, vmax, run.series, run.pairs);
    archive.check("a value of a particle", [&] { return probes.follows(p) && are_numbers(); });
    archive.check("the time, the step or a series", [&] {
      const Series& series = run.series;
      const bool counted = probes.size() == 0 ? series.time.empty()
                                              : std::cmp_equal(series.time.size() - 1, run.steps) &&
                                                    series.time.back() == run.time;
      return std::isfinite(run.time) && run.time >= 0 && run.steps >= 0 && run.steps < most_steps &&
             counted && (is_within_bounds(vmax) || (vmax > 0 && vmax <= 2 * fastest()));
    });
    method(archive);
  }

 private:
  /// `speed` in m/s. Returns false for NaN.
  bool is_within_bounds(double speed) const {
    return speed >= 0 && speed <= greatest_mach_number * constants.c0;
  }
  void throw_if_diverged() const;
  double fastest() const;  // m/s
  bool are_of_this_scene() const;
  bool are_numbers() const;
};

}  // namespace taut
