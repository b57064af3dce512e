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

/// Loads, gravity and damping −c m v. They move free particles only. In each step call `set_time`, then `act` and
/// `count` for each velocity, or `acceleration` in each stage and `count` at the end.
template <int Dim>
class Loads {
 public:
  using V = Vec<double, Dim>;

  /// Throws SceneError if a load is on no particle that is free at some time, or a traction is not on one layer at a
  /// face.
  Loads(const Scene& scene, const InitialParticles& initial);

  void act_on_faces(const Scene& scene, const InitialParticles& initial, FaceRule rule,
                    const std::vector<Point>& surface, double reach);

  /// Distributes forces and force densities by `volume` (by id, m^Dim).
  void spread_by(const std::vector<double>& volume, const Scene& scene, const InitialParticles& initial);

  bool active() const { return active_; }

  /// `t`: middle of the velocity update, s. Expressions are not thread-safe.
  void set_time(double t);

  /// Acceleration by gravity and, if `free`, by loads, m/s².
  V pull(const Particles<Dim>& s, int i, bool free) const { return free && active_ ? push(s, i) : g_; }

  /// By loads, gravity and damping, m/s².
  V acceleration(const Particles<Dim>& s, int i) const { return push(s, i) - damping_ * s.v[i]; }

  /// `dt` in s. Damping acts on the mean of the old and the new velocity.
  void act(const Particles<Dim>& s, int i, double dt, V& v) {
    const double half = 0.5 * damping_ * dt * s.mobile[i];
    v += (dt * s.mobile[i]) * push(s, i);
    v = (1 / (1 + half)) * (v - half * s.v[i]);
  }
  /// `mean`: velocity, m/s.
  void count(const Particles<Dim>& s, int i, double dt, const V& mean) {
    work_[s.id[i]] += dt * s.mobile[i] * s.m[i] * dot(push(s, i), mean);
    damped_[s.id[i]] += dt * s.mobile[i] * s.m[i] * damping_ * dot(mean, mean);
  }

  /// Since the start, J.
  double work(int id) const { return work_.empty() ? 0 : work_[id]; }
  double work() const { return std::accumulate(work_.begin(), work_.end(), 0.0); }
  double damped() const { return std::accumulate(damped_.begin(), damped_.end(), 0.0); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(work_, damped_);
  }

 private:
  struct Region {
    std::function<double(double)> ramp;
    std::vector<std::pair<int, V>> shares;  // id, N at ramp factor 1
    double now = 0;
  };

  V push(const Particles<Dim>& s, int i) const { return g_ + (1 / s.m[i]) * force_[s.id[i]]; }

  static std::vector<std::pair<int, V>> shares(const Load& load, const Scene& scene,
                                               const InitialParticles& initial, int body);

  bool active_ = false;
  std::array<std::function<double(double)>, 3> gravity_;
  V g_{};               // m/s²
  double damping_ = 0;  // 1/s
  std::vector<Region> regions_;
  std::vector<V> force_;               // [id] N
  std::vector<double> work_, damped_;  // [id] J
};

}  // namespace taut
