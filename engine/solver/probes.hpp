#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/probe_kinds.hpp"
#include "engine/solver/simulation.hpp"

namespace taut {

/// Records the probes of a scene at every step.
template <int Dim>
class ProbeRecorder {
 public:
  /// `support`: the radius within which particles act on each other, m. Throws SceneError for a probe that is
  /// not in its body.
  ProbeRecorder(const Scene& scene, const InitialParticles& initial, double support);

  /// Finds where each particle is stored now and updates what changes with a neighbour search only.
  void rebuilt(const Particles<Dim>& s, const Neighbors& neighbors, double support);
  /// Appends a row to `series`.
  void record(const Particles<Dim>& s, double time, ProbeSource<Dim>& source, Series& series);

  std::size_t size() const { return followers_.size(); }
  /// `where_` is right for the current order of the particles.
  bool follows(const Particles<Dim>& s) const {
    for (int i = 0; i < s.size(); ++i)
      if (where_[s.id[i]] != i) return false;
    return true;
  }

  /// The members that change as particles are stored in another order.
  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(where_);
    archive(support_);
    for (ProbeFollower<Dim>& f : followers_) {
      archive.indices(f.pairs, std::pair(where_.size(), where_.size()));
      archive(f.last);
    }
  }

 private:
  ProbeView<Dim> view(const Particles<Dim>& s) const { return {s, where_, first_, diameter_, support_}; }

  std::vector<ProbeFollower<Dim>> followers_;
  std::vector<int> where_;        // [id] place in the solver's order
  std::vector<int> first_;        // [body] its first particle
  std::vector<double> diameter_;  // [id] of its whole cell, a spacing from which the laws of pairs act, m
  double support_ = 0;
  std::vector<int> stressed_;  // [id] of the particles whose stress is recorded
};

}  // namespace taut
