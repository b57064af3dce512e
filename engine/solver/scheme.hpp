#pragma once

#include <span>

#include "engine/core/archive.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"
#include "engine/solver/common.hpp"

namespace taut {

/// Algorithm and fields of a family.
template <int Dim>
class Scheme {
 public:
  virtual ~Scheme() = default;

  virtual double step_size() const = 0;  // s
  virtual void step(double dt) = 0;

  /// `groups` must ascend; `out` must come from Common::begin_snapshot.
  virtual void show(Snapshot& out, std::span<const int> groups) const = 0;
  /// See Simulation::motion.
  virtual bool show_motion(Snapshot& /*out*/) const { return false; }

  /// Contact force on the first body of `probe` over the last step of `dt` seconds, N.
  virtual Vec<double, Dim> contact_force(const Probe& probe, double dt) const = 0;

  virtual void save(Saver& saver) = 0;
  virtual void load(Loader& loader) = 0;
};

}  // namespace taut
