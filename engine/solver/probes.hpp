#pragma once

#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/probe_kinds.hpp"
#include "engine/solver/simulation.hpp"

namespace taut {

template <int Dim>
class ProbeRecorder {
 public:
  /// `support`: radius of interaction, m. Throws SceneError if a probe does not fit its body.
  ProbeRecorder(const Scene& scene, const InitialParticles& initial, double support);

  /// Call after each neighbour search.
  void rebuilt(const Particles<Dim>& s, const Neighbors& neighbors, double support);
  void record(const Particles<Dim>& s, double time, ProbeSource<Dim>& source, Series& series);

  std::size_t size() const { return followers_.size(); }
  bool follows(const Particles<Dim>& s) const {
    for (int i = 0; i < s.size(); ++i)
      if (storage_of_id_[s.id[i]] != i) return false;
    return true;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(storage_of_id_);
    archive(support_);
    for (ProbeFollower<Dim>& f : followers_) {
      archive.indices(f.pairs, std::pair(storage_of_id_.size(), storage_of_id_.size()));
      archive(f.last);
    }
  }

 private:
  ProbeView<Dim> view(const Particles<Dim>& s) const {
    return {s, storage_of_id_, first_, diameter_, support_};
  }

  std::vector<ProbeFollower<Dim>> followers_;
  std::vector<int> storage_of_id_;
  std::vector<int> first_;
  std::vector<double> diameter_;  // [id] V^(1/Dim) of the whole cell, m
  double support_ = 0;
  std::vector<int> stressed_;  // ids
};

}  // namespace taut
