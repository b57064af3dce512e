#pragma once

#include <array>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/solver/face_loads.hpp"
#include "engine/solver/particles.hpp"

namespace taut {

/// What acts on particles from outside and follows them: loads of regions and gravity
/// (engine/scene/scene.hpp), and the viscous force −c m v of a scene that is to come to rest. A damping of c
/// = 2 ω, ω the slowest mode that the loads excite, brings it to rest soonest; where it comes to rest does
/// not depend on c, which is 0 in scenes of motion. None of it acts on what is held or driven.
///
/// In each step: `set_time`, then `act` and `count` for each new velocity before it is used, or where a
/// scheme has stages, `acceleration` in each of them and `count` at the end.
template <int Dim>
class Loads {
 public:
  using V = Vec<double, Dim>;

  /// Throws SceneError where all particles of a region are held, or driven to the end.
  Loads(const Scene& scene, const InitialParticles& initial);

  /// Tractions act on the face instead of the outermost layer, for methods whose neighbours are those of the
  /// start: see solver/face_loads.hpp. A region that is no layer keeps what it has. `surface` is S by id,
  /// `reach` that of the method's gradient, m.
  void act_on_faces(const Scene& scene, const InitialParticles& initial, FaceRule rule,
                    const std::vector<Point>& surface, double reach);

  /// Forces and their densities are spread by these volumes, by id, m^Dim, in place of those of the cells, for a method
  /// whose particles are as heavy as they are: so a density moves all alike, as gravity does.
  void spread_by(const std::vector<double>& volume, const Scene& scene, const InitialParticles& initial);

  bool active() const { return active_; }

  /// `t`, s, is the middle of the time that the velocities of a step go through. Not for use inside a pass:
  /// expressions serve one thread.
  void set_time(double t);

  /// On particle i, m/s²: of gravity alone where it is held or driven, which does not feel loads.
  V pull(const Particles<Dim>& s, int i, bool free) const { return free && active_ ? push(s, i) : g_; }

  /// What they add to the acceleration of particle i at its present velocity, m/s².
  V acceleration(const Particles<Dim>& s, int i) const { return push(s, i) - damping_ * s.v[i]; }

  /// Adds what they do to `v`, the velocity that particle i would take after `dt` without them. The viscous
  /// force is that of the mean of the old and the new velocity.
  void act(const Particles<Dim>& s, int i, double dt, V& v) {
    const double half = 0.5 * damping_ * dt * s.mobile[i];
    v += (dt * s.mobile[i]) * push(s, i);
    v = (1 / (1 + half)) * (v - half * s.v[i]);
  }
  /// Notes the work of a step of `dt` in which particle i had the velocity `mean`.
  void count(const Particles<Dim>& s, int i, double dt, const V& mean) {
    work_[s.id[i]] += dt * s.mobile[i] * s.m[i] * dot(push(s, i), mean);
    damped_[s.id[i]] += dt * s.mobile[i] * s.m[i] * damping_ * dot(mean, mean);
  }

  /// Of loads and gravity on a particle so far, J (per metre depth in 2D).
  double work(int id) const { return work_.empty() ? 0 : work_[id]; }
  /// Of loads and gravity so far, J (per metre depth in 2D).
  double work() const { return std::accumulate(work_.begin(), work_.end(), 0.0); }
  /// What the viscous force has taken so far, J (per metre depth in 2D).
  double damped() const { return std::accumulate(damped_.begin(), damped_.end(), 0.0); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(work_, damped_);
  }

 private:
  struct Region {
    std::function<double(double)> ramp;
    std::vector<std::pair<int, V>> shares;  // id, N at a factor of 1
    double now = 0;                         // the factor
  };

  V push(const Particles<Dim>& s, int i) const { return g_ + (1 / s.m[i]) * force_[s.id[i]]; }

  static std::vector<std::pair<int, V>> shares(const Load& load, const Scene& scene,
                                               const InitialParticles& initial, int body);

  bool active_ = false;
  std::array<std::function<double(double)>, 3> gravity_;
  V g_{};               // m/s²
  double damping_ = 0;  // c, 1/s
  std::vector<Region> regions_;
  std::vector<V> force_;               // [id] of all regions, N
  std::vector<double> work_, damped_;  // [id] J
};

}  // namespace taut
