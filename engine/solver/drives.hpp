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

/// Particles that do not move along some of the axes: rollers, planes of symmetry, edges that may slide. What
/// holds them does no work. A drive, as long as it lasts, stands above a guide.
template <int Dim>
class Guides {
 public:
  explicit Guides(const InitialParticles& initial) : along_(initial.guided) {}

  bool active() const { return !along_.empty(); }
  /// Bit k: particle `id` does not move along axis k.
  unsigned char axes(int id) const { return active() ? along_[id] : 0; }

  /// Takes from `v`, a new velocity of particle `id`, what it cannot have.
  void hold(int id, Vec<double, Dim>& v) const {
    if (!active() || along_[id] == 0) return;
    for (int k = 0; k < Dim; ++k)
      if (along_[id] >> k & 1) v[k] = 0;
  }

  /// Of `force` what they may be the reason for.
  Vec<double, Dim> along(int id, const Vec<double, Dim>& force) const {
    Vec<double, Dim> kept{};
    for (int k = 0; k < Dim && active(); ++k)
      if (along_[id] >> k & 1) kept[k] = force[k];
    return kept;
  }

 private:
  std::vector<unsigned char> along_;  // [id] bit k: axis k
};

/// Particles whose velocity is given up to a time (Drive in engine/scene/scene.hpp). Everything else about
/// them goes on as usual: density and stress follow from the velocities where those of what is held do
/// (strains_what_is_held in methods/ul_split/), and others feel them.
///
/// In each step: `set_time`, then `replace` for each new velocity before it is used.
template <int Dim>
class Drives {
 public:
  using V = Vec<double, Dim>;

  Drives(const Scene& scene, const InitialParticles& initial);

  /// False without drives, and once all of them are over.
  bool active() const { return active_; }
  int number_of_active() const { return static_cast<int>(std::ranges::count_if(drives_, &Timed::on)); }

  /// `t`, s, is where in time the new velocities of a step stand: at its end for a scheme that takes half of
  /// the way with the old and half with the new ones, in its middle for one that takes all of it with the
  /// new. So the way of a driven particle is the integral of its velocity to second order in either. Not for
  /// use inside a pass: expressions serve one thread.
  void set_time(double t);

  /// The drive of a particle does not let it go before the run is over.
  bool lasts(int id) const { return !drives_.empty() && drive_[id] >= 0 && drives_[drive_[id]].lasts(); }
  bool moves(int id) const { return active_ && drive_[id] >= 0 && drives_[drive_[id]].on; }
  const V& velocity(int id) const { return drives_[drive_[id]].now; }  // m/s, of one that is moved

  /// Replaces `v`, the velocity that particle i would take as a free one, by its own if it is moved. What the
  /// drive adds to the momentum, times the mean of the old and the new velocity, is its work.
  void replace(const Particles<Dim>& s, int i, V& v) {
    const int id = s.id[i];
    if (!moves(id)) return;
    const V& given = velocity(id);
    work_[id] += 0.5 * s.m[i] * dot(given - v, s.v[i] + given);
    v = given;
  }

  /// On a particle so far, J (per metre depth in 2D).
  double work(int id) const { return work_.empty() ? 0 : work_[id]; }
  /// Of all drives so far, J (per metre depth in 2D).
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
    std::array<std::function<double(double)>, 3> velocity;  // m/s, of the time in s
    double until;                                           // s; infinite where it lasts
    bool on = true;
    V now{};  // m/s

    bool lasts() const { return until == std::numeric_limits<double>::infinity(); }
  };

  bool active_ = false;
  std::vector<Timed> drives_;
  std::vector<int> drive_;    // [id] index into drives_, or -1
  std::vector<double> work_;  // [id] J
};

/// What holds, guides and drives particles, measured where a probe asks for it: the momentum that a particle
/// took in a step less all that else acted on it. In each step: `begin`, then `add` for what acts on a
/// particle, held or not, within its body and in contact.
template <int Dim>
class Reactions {
 public:
  using V = Vec<double, Dim>;

  explicit Reactions(const Scene& scene)
      : active_(std::ranges::any_of(
            scene.probes, [](const Probe& probe) { return probe.kind == Probe::Kind::reaction; })) {}

  bool active() const { return active_; }

  /// A step of `dt`, s, from the velocities `v`. A particle keeps its place in the solver's order till its
  /// end.
  void begin(const std::vector<V>& v, double dt) {
    v_ = v;
    dt_ = dt;
    impulse_.assign(v.size(), V{});
  }
  double dt() const { return dt_; }          // s; 0 before the first step
  V* impulses() { return impulse_.data(); }  // [i] N s
  /// An impulse on particle i, N s (per metre depth in 2D).
  void add(int i, const V& impulse) { impulse_[i] += impulse; }

  /// The mean force on particle i over the step that nothing told of so far makes up for, N.
  V missing(const Particles<Dim>& s, int i) const {
    return (1 / dt_) * (s.m[i] * (s.v[i] - v_[i]) - impulse_[i]);
  }

 private:
  bool active_;
  double dt_ = 0;
  std::vector<V> v_, impulse_;  // m/s, N s
};

}  // namespace taut
