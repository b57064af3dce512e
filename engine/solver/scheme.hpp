#pragma once

#include <span>

#include "engine/core/archive.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"
#include "engine/solver/common.hpp"

namespace taut {

/// Time-stepping scheme of one method: its own fields and a reference to Common, which ParticleSimulation owns.
template <int Dim>
class Scheme {
 public:
  virtual ~Scheme() = default;

  virtual double step_size() const = 0;  // s
  virtual void step(double dt) = 0;

  /// Stores these groups of four particles, in ascending order, in a snapshot begun by Common::begin_snapshot.
  virtual void show(Snapshot& out, std::span<const int> groups) const = 0;
  /// Stores only the fields of Simulation::motion. Returns false if energies need the stresses.
  virtual bool show_motion(Snapshot& /*out*/) const { return false; }

  /// Contact force on the first body of `probe` from the other body or wall, over the last step of `dt`, N.
  virtual Vec<double, Dim> contact_force(const Probe& probe, double dt) const = 0;

  virtual void save(Saver& saver) = 0;
  virtual void load(Loader& loader) = 0;
};

}  // namespace taut
