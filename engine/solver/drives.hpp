#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/solver/particles.hpp"

namespace taut {

/// Particles that cannot move along some axes (rollers).
template <int Dim>
class Guides {
 public:
  explicit Guides(const InitialParticles& initial) : along_(initial.guided) {}

  bool active() const { return !along_.empty(); }
  /// Bit k: particle `id` does not move along axis k.
  unsigned char axes(int id) const { return active() ? along_[id] : 0; }

  void constrain(int id, Vec<double, Dim>& v) const {
    if (!active() || along_[id] == 0) return;
    for (int k = 0; k < Dim; ++k)
      if (along_[id] >> k & 1) v[k] = 0;
  }

  Vec<double, Dim> constrained_part(int id, const Vec<double, Dim>& force) const {
    Vec<double, Dim> kept{};
    for (int k = 0; k < Dim && active(); ++k)
      if (along_[id] >> k & 1) kept[k] = force[k];
    return kept;
  }

 private:
  std::vector<unsigned char> along_;  // [id] see `axes`
};

/// Particles with prescribed velocity. In each step call `set_time`, then `replace` for each new velocity.
template <int Dim>
class Drives {
 public:
  using V = Vec<double, Dim>;

  Drives(const Scene& scene, const InitialParticles& initial);

  bool active() const { return active_; }
  int number_of_active() const { return static_cast<int>(std::ranges::count_if(drives_, &Timed::on)); }

  /// `t`: time of the new velocities, s. Expressions are not thread-safe.
  void set_time(double t);

  /// Whether the particle is driven until the end of the run.
  bool lasts(int id) const { return !drives_.empty() && drive_[id] >= 0 && drives_[drive_[id]].lasts(); }
  bool moves(int id) const { return active_ && drive_[id] >= 0 && drives_[drive_[id]].on; }
  const V& velocity(int id) const { return drives_[drive_[id]].now; }  // m/s

  void replace(const Particles<Dim>& s, int i, V& v) {
    const int id = s.id[i];
    if (!moves(id)) return;
    const V& given = velocity(id);
    work_[id] += 0.5 * s.m[i] * dot(given - v, s.v[i] + given);
    v = given;
  }

  /// `work` in J.
  void add_work(int id, double work) {
    if (moves(id)) work_[id] += work;
  }

  /// Since the start, J.
  double work(int id) const { return work_.empty() ? 0 : work_[id]; }
  double work() const { return std::accumulate(work_.begin(), work_.end(), 0.0); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(active_);
    archive.fixed(work_);
    for (Timed& drive : drives_) archive(drive.on, drive.now);
    archive.check("a drive", [&] { return active_ == std::ranges::any_of(drives_, &Timed::on); });
  }

 private:
  struct Timed {
    std::array<std::function<double(double)>, 3> velocity;  // m/s; argument in s
    double until;                                           // s; may be infinite
    bool on = true;
    V now{};  // m/s

    bool lasts() const { return until == std::numeric_limits<double>::infinity(); }
  };

  bool active_ = false;
  std::vector<Timed> drives_;
  std::vector<int> drive_;    // [id] index in `drives_`, or -1
  std::vector<double> work_;  // [id] J
};

/// Reaction forces for probes: momentum change minus recorded impulses. In each step call `begin`, then `add`.
template <int Dim>
class Reactions {
 public:
  using V = Vec<double, Dim>;

  explicit Reactions(const Scene& scene)
      : active_(std::ranges::any_of(
            scene.probes, [](const Probe& probe) { return probe.kind == Probe::Kind::reaction; })) {}

  bool active() const { return active_; }

  /// `dt` in s. The storage order must not change during the step.
  void begin(const std::vector<V>& v, double dt) {
    v_ = v;
    dt_ = dt;
    impulse_.assign(v.size(), V{});
  }
  double dt() const { return dt_; }          // s; initially 0
  V* impulses() { return impulse_.data(); }  // [i] N s
  void add(int i, const V& impulse) { impulse_[i] += impulse; }

  /// Mean over the step, N.
  V unexplained_force(const Particles<Dim>& s, int i) const {
    return (1 / dt_) * (s.m[i] * (s.v[i] - v_[i]) - impulse_[i]);
  }

 private:
  bool active_;
  double dt_ = 0;
  std::vector<V> v_, impulse_;  // m/s, N s
};

}  // namespace taut
