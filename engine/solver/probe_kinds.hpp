#pragma once

#include <utility>
#include <vector>

#include "engine/contact/contact_mechanism.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/layout/material_point.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"
#include "engine/solver/particles.hpp"

namespace taut {

/// Interface through which probes read from their solver.
template <int Dim>
class ProbeSource {
 public:
  using V = Vec<double, Dim>;

  virtual ~ProbeSource() = default;
  virtual ContactsOfFaces<Dim>* faces() = 0;  // faces that gaps are measured from; may be null
  virtual V reaction(int i) = 0;              // constraint force on stored particle i over the last step, N
  virtual V contact_force(const Probe& probe, double dt) = 0;  // over the last step of `dt`, s, N
  /// Snapshot with the current stresses of these stored particles.
  virtual const Snapshot& shown(const std::vector<int>& stored) = 0;
};

template <int Dim>
struct ProbeRow;

/// State of a probe during a run; each kind uses some of the members.
template <int Dim>
struct ProbeFollower {
  Probe probe;
  const ProbeRow<Dim>* row = nullptr;
  std::vector<PointWeight> at, to;         // material points, or particles of a body
  Vec<double, Dim> beside{}, to_beside{};  // offset of a point from the single particle that represents it, m
  std::vector<std::pair<int, int>> pairs;  // stored particles of two bodies within the support
  std::vector<int> image;                  // [particle of a body] id of its mirror image
  double last = 0;                         // last value, m or rad
};

/// Data of the set-up of probes.
struct ProbeSetUp {
  const Scene& scene;
  const InitialParticles& initial;
  double reach;  // of material points, m
};

/// Particles in the form that probes read.
template <int Dim>
struct ProbeView {
  const Particles<Dim>& s;
  const std::vector<int>& where;        // [id] storage index
  const std::vector<int>& first;        // [body] first particle
  const std::vector<double>& diameter;  // [id] m
  double support;                       // range of `pairs`, m

  Vec<double, Dim> place(const std::vector<PointWeight>& point) const {
    Vec<double, Dim> x{};
    for (const PointWeight& w : point) x += w.weight * s.x[where[w.particle]];
    return x;
  }
};

/// The end of a step.
template <int Dim>
struct ProbeStep : ProbeView<Dim> {
  ProbeSource<Dim>& source;
  const Snapshot* shown;              // with the stresses of the particles of rows with `takes_stress`
  double time, dt;                    // s; dt is 0 at the start
  const std::vector<double>& before;  // values of the probes before this one
  bool is_look;                       // every few steps, for expensive values
};

/// A kind of probe.
template <int Dim>
struct ProbeRow {
  Probe::Kind kind;
  /// Finds the particles of the probe; may be null. Throws SceneError if the scene contains none.
  void (*set_up)(ProbeFollower<Dim>&, const ProbeSetUp&);
  double (*value)(ProbeFollower<Dim>&, const ProbeStep<Dim>&);
  /// Called after a neighbour search, which may have changed the storage order; may be null.
  void (*rebuilt)(ProbeFollower<Dim>&, const ProbeView<Dim>&, const Neighbors&) = nullptr;
  bool takes_stress = false;
};

/// Row of the probe's kind. Throws SceneError if the kind is unknown.
template <int Dim>
const ProbeRow<Dim>& probe_row(const Probe& probe);

}  // namespace taut
