#pragma once

#include <algorithm>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/solver/state.hpp"

namespace taut::inline TAUT_ISA {

/// What holds, guides and drives particles, measured where a probe asks for it: the momentum that a particle took
/// in a step less all that else acted on it. In each step: `begin`, then `add` for what acts on a particle, held or
/// not, within its body and in contact.
template <int Dim>
class Reactions {
 public:
  using V = Vec<double, Dim>;

  explicit Reactions(const Scene& scene)
      : active_(std::ranges::any_of(
            scene.probes, [](const Probe& probe) { return probe.kind == Probe::Kind::reaction; })) {}

  bool active() const { return active_; }

  /// A step of `dt`, s, from the velocities `v`. A particle keeps its place in the solver's order till its end.
  void begin(const std::vector<V>& v, double dt) {
    v_ = v;
    dt_ = dt;
    impulse_.assign(v.size(), V{});
  }
  double dt() const { return dt_; }  // s; 0 before the first step
  /// An impulse on particle i, N s (per metre depth in 2D).
  void add(int i, const V& impulse) { impulse_[i] += impulse; }

  /// The mean force on particle i over the step that nothing told of so far makes up for, N.
  V missing(const State<Dim>& s, int i) const {
    return (1 / dt_) * (s.m[i] * (s.v[i] - v_[i]) - impulse_[i]);
  }

 private:
  bool active_;
  double dt_ = 0;
  std::vector<V> v_, impulse_;  // m/s, N s
};

}  // namespace taut::inline TAUT_ISA
