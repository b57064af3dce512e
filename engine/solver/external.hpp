#pragma once

#include <vector>

#include "engine/solver/drives.hpp"
#include "engine/solver/kick.hpp"
#include "engine/solver/loads.hpp"
#include "engine/solver/particles.hpp"

namespace taut {

template <int Dim>
struct External {
  using V = Vec<double, Dim>;

  Drives<Dim> drives;
  Guides<Dim> guides;
  Loads<Dim> loads;
  Reactions<Dim> reactions;

  External(const Scene& scene, const InitialParticles& initial)
      : drives(scene, initial), guides(initial), loads(scene, initial), reactions(scene) {
    update_steering(initial);
  }

  bool active() const { return drives.active() || loads.active() || guides.active(); }

  /// `t`: time of the new velocities, s. Call once in each step, before `act`.
  void set_time(double dt, double t, const Particles<Dim>& p) {
    const int before = drives.number_of_active();
    drives.set_time(t);
    if (drives.number_of_active() != before) update_steering();  // all drives begin at t = 0
    loads.set_time(t - 0.5 * dt);
    if (reactions.active()) reactions.begin(p.v, dt);
  }
  /// `v`: new velocity. Records the work.
  void act(const Particles<Dim>& p, int i, double dt, V& v) {
    if (drives.moves(p.id[i])) return drives.replace(p, i, v);
    const bool loaded = loads.active();
    if (loaded) loads.act(p, i, dt, v);
    guides.constrain(p.id[i], v);
    if (loaded) loads.count(p, i, dt, 0.5 * (p.v[i] + v));
  }

  Steering<Dim> steering() const { return {drives.active() || guides.active() ? axes_.data() : nullptr}; }

  /// Mean force on particle i by its clamp, guide or drive over the last step, N.
  V reaction(const Particles<Dim>& p, int i) const {
    const int id = p.id[i];
    const bool free = p.mobile[i] != 0 && !drives.moves(id);
    const V all = reactions.unexplained_force(p, i) - p.m[i] * loads.pull(p, i, free);
    return free ? guides.constrained_part(id, all) : all;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(drives, loads);
    if constexpr (Archive::loads) update_steering();
  }

 private:
  void update_steering() {
    for (std::size_t id = 0; id < axes_.size(); ++id)
      axes_[id] =
          drives.moves(static_cast<int>(id)) ? Steering<Dim>::driven : guides.axes(static_cast<int>(id));
  }
  void update_steering(const InitialParticles& initial) {
    axes_.resize(static_cast<std::size_t>(initial.size()));
    update_steering();
  }

  std::vector<unsigned char> axes_;
};

}  // namespace taut
