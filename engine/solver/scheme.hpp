#pragma once

#include <span>

#include "engine/core/archive.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"
#include "engine/solver/common.hpp"

namespace taut {

/// Algorithm and fields of one method; refers to Common, which ParticleSimulation owns.
template <int Dim>
class Scheme {
 public:
  virtual ~Scheme() = default;

  virtual double step_size() const = 0;  // s
  virtual void step(double dt) = 0;

  /// Stores ascending groups of four in a snapshot from Common::begin_snapshot.
  virtual void show(Snapshot& out, std::span<const int> groups) const = 0;
  /// For Simulation::motion; false if energies need stresses.
  virtual bool show_motion(Snapshot& /*out*/) const { return false; }

  /// See Common::contact_force.
  virtual Vec<double, Dim> contact_force(const Probe& probe, double dt) const = 0;

  virtual void save(Saver& saver) = 0;
  virtual void load(Loader& loader) = 0;
};

}  // namespace taut
