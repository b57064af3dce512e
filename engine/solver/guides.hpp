#pragma once

#include <vector>

#include "engine/scene/initial_particles.hpp"
#include "engine/solver/state.hpp"

namespace taut::inline TAUT_ISA {

/// Particles that do not move along some of the axes: rollers, planes of symmetry, edges that may slide. What
/// holds them does no work. A drive, as long as it lasts, stands above a guide.
template <int Dim>
class Guides {
 public:
  explicit Guides(const InitialParticles& initial) : along_(initial.guided) {}

  bool active() const { return !along_.empty(); }

  /// Takes from `v`, a new velocity of particle `id`, what it cannot have.
  void hold(int id, Vec<double, Dim>& v) const {
    if (!active() || along_[id] == 0) return;
    for (int k = 0; k < Dim; ++k)
      if (along_[id] >> k & 1) v[k] = 0;
  }

 private:
  std::vector<unsigned char> along_;  // [id] bit k: axis k
};

}  // namespace taut::inline TAUT_ISA
