#pragma once

#include <utility>
#include <vector>

#include "engine/scene/initial_particles.hpp"
#include "engine/scene/material_point.hpp"
#include "engine/snapshot.hpp"
#include "engine/solver/contact/contact.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/simulation.hpp"

namespace taut::inline TAUT_ISA {

/// What probes ask of the solver that has them.
template <int Dim>
class ProbeSource {
 public:
  using V = Vec<double, Dim>;

  virtual ~ProbeSource() = default;
  virtual ContactsOfFaces<Dim>* faces() = 0;  // that measure gaps, if there are any
  virtual V reaction(int i) = 0;              // on stored particle i, of what holds it over the last step, N
  virtual V contact_force(const Probe& probe, double dt) = 0;  // over the last step, of `dt`, N
  /// With the stresses of these stored particles as they are now.
  virtual const Snapshot& shown(const std::vector<int>& stored) = 0;
};

/// Follows a scene's probes at every step.
template <int Dim>
class ProbeRecorder {
 public:
  /// `support`: the radius within which particles act on each other, m. Throws SceneError for a probe that is
  /// not in its body.
  ProbeRecorder(const Scene& scene, const InitialParticles& initial, double support);

  /// Where each particle is stored now; refreshes what is only looked at between rebuilds.
  void rebuilt(const Particles<Dim>& s, const Neighbors& neighbors, double support);
  /// Appends a row to `series`.
  void record(const Particles<Dim>& s, double time, ProbeSource<Dim>& source, Series& series);

  std::size_t size() const { return probes_.size(); }
  /// Knows where the particles are.
  bool follows(const Particles<Dim>& s) const {
    for (int i = 0; i < s.size(); ++i)
      if (where_[s.id[i]] != i) return false;
    return true;
  }

  /// What changes as particles are stored in another order.
  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(where_);
    archive(support_);
    for (Follower& f : followers_) {
      archive.indices(f.pairs, std::pair(where_.size(), where_.size()));
      archive(f.held_value);
    }
  }

 private:
  struct Follower {
    std::vector<PointWeight> at,
        to;  // material points, or the particles of a body, or those of it that are held
    Vec<double, Dim> beside{}, to_beside{};  // from one particle that stands for a point to it, m
    std::vector<std::pair<int, int>> pairs;  // gap: stored particles of the two bodies within the support
    double held_value = 0;                   // of what is looked at between rebuilds only, m; of a turn, rad
    std::vector<int> image;                  // [particle of a body] id of the one that is its mirror image
  };

  std::vector<PointWeight> point(const Scene& scene, const InitialParticles& initial, const Probe& probe,
                                 const Point& at, double reach) const;
  static Vec<double, Dim> beside(const InitialParticles& initial, const std::vector<PointWeight>& point,
                                 const Point& at);
  std::vector<PointWeight> point_of_motion(const Scene& scene, const InitialParticles& initial,
                                           const Probe& probe, const Point& at, double reach) const;
  std::vector<PointWeight> point_of_stress(const Scene& scene, const InitialParticles& initial,
                                           const Probe& probe, double reach) const;
  std::vector<PointWeight> held_particles(const InitialParticles& initial, const Probe& probe) const;
  void find_close_pairs(const Particles<Dim>& s, const Neighbors& neighbors, const Probe& probe,
                        Follower& f) const;
  static bool of_whole_body(Probe::Kind kind) {
    return kind == Probe::Kind::mean_velocity || kind == Probe::Kind::mean_position ||
           kind == Probe::Kind::greatest_position;
  }
  static bool of_a_point(Probe::Kind kind) {
    return kind == Probe::Kind::displacement || kind == Probe::Kind::position ||
           kind == Probe::Kind::velocity || kind == Probe::Kind::distance || kind == Probe::Kind::turn;
  }
  static std::vector<int> images(const Scene& scene, const InitialParticles& initial, const Probe& probe);
  double mirror_asymmetry(const Particles<Dim>& s, const Probe& probe, const Follower& f) const;
  /// By mass.
  double mean(const Particles<Dim>& s, const Follower& f, const std::vector<Vec<double, Dim>>& of,
              int axis) const;
  double angle(const Particles<Dim>& s, const Probe& probe, const Follower& f) const;
  double stress(const Snapshot& shown, const Probe& probe, const Follower& f) const;
  double force(const Probe& probe, const Follower& f, double dt, ProbeSource<Dim>& source) const;
  double value(const Particles<Dim>& s, const Probe& probe, const Follower& f,
               ProbeSource<Dim>& source) const;
  std::vector<int> stored(std::vector<int> ids) const {
    for (int& id : ids) id = where_[id];
    return ids;
  }
  Vec<double, Dim> place(const Particles<Dim>& s, const std::vector<PointWeight>& point) const {
    Vec<double, Dim> x{};
    for (const PointWeight& w : point) x += w.weight * s.x[where_[w.particle]];
    return x;
  }

  std::vector<Probe> probes_;
  std::vector<Follower> followers_;
  std::vector<int> where_;        // [id] place in the solver's order
  std::vector<int> first_;        // first particle of each body
  std::vector<double> diameter_;  // [id] of its whole cell, a spacing from which the laws of pairs act, m
  double support_ = 0;
  std::vector<int> stressed_;  // [id] of the particles whose stress is looked at
};

}  // namespace taut::inline TAUT_ISA
