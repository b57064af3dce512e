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

template <int Dim>
class ProbeSource {
 public:
  using V = Vec<double, Dim>;

  virtual ~ProbeSource() = default;
  virtual ContactsOfFaces<Dim>* faces() = 0;                   // for gaps; may be null
  virtual V reaction(int i) = 0;                               // constraint force, N
  virtual V contact_force(const Probe& probe, double dt) = 0;  // N
  virtual const Snapshot& shown(const std::vector<int>& stored) = 0;
};

template <int Dim>
struct ProbeRow;

template <int Dim>
struct ProbeFollower {
  Probe probe;
  const ProbeRow<Dim>* row = nullptr;
  std::vector<PointWeight> at, to;
  Vec<double, Dim> beside{}, to_beside{};  // offset from a single particle, m
  std::vector<std::pair<int, int>> pairs;  // storage indices of particles of both bodies within `support`
  std::vector<int> image;                  // [particle of the first body] id of its mirror image
  double last = 0;                         // m or rad
};

struct ProbeSetUp {
  const Scene& scene;
  const InitialParticles& initial;
  double reach;  // m
};

template <int Dim>
struct ProbeView {
  const Particles<Dim>& s;
  const std::vector<int>& where;        // [id] storage index
  const std::vector<int>& first;        // [body] first id
  const std::vector<double>& diameter;  // [id] m
  double support;                       // m

  Vec<double, Dim> place(const std::vector<PointWeight>& point) const {
    Vec<double, Dim> x{};
    for (const PointWeight& w : point) x += w.weight * s.x[where[w.particle]];
    return x;
  }
};

template <int Dim>
struct ProbeStep : ProbeView<Dim> {
  ProbeSource<Dim>& source;
  const Snapshot* shown;
  double time, dt;                    // s; initially dt = 0
  const std::vector<double>& before;  // values of the earlier probes
  bool evaluates_expensive;           // true every 32 steps
};

template <int Dim>
struct ProbeRow {
  Probe::Kind kind;
  /// May be null. Throws SceneError if the probe does not fit its body.
  void (*set_up)(ProbeFollower<Dim>&, const ProbeSetUp&);
  double (*value)(ProbeFollower<Dim>&, const ProbeStep<Dim>&);
  /// Called after each neighbour search; may be null.
  void (*rebuilt)(ProbeFollower<Dim>&, const ProbeView<Dim>&, const Neighbors&) = nullptr;
  bool takes_stress = false;
};

/// Throws SceneError if the kind is unknown.
template <int Dim>
const ProbeRow<Dim>& probe_row(const Probe& probe);

}  // namespace taut
