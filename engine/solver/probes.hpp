#pragma once

#include <cmath>
#include <vector>

#include "engine/error.hpp"
#include "engine/scene/initial_particles.hpp"
#include "engine/scene/material_point.hpp"
#include "engine/solver/face_contacts.hpp"
#include "engine/solver/running.hpp"
#include "engine/solver/state.hpp"

namespace taut::inline TAUT_ISA {

/// Follows a scene's probes at every step.
template <int Dim>
class ProbeRecorder {
 public:
  /// Throws SceneError for a probe that is not in its body.
  ProbeRecorder(const Scene& scene, const InitialParticles& initial, double reach);

  /// Where each particle is stored now; refreshes what is only looked at between rebuilds.
  void rebuilt(const State<Dim>& s, double support);
  /// Appends a row to `series`. `faces` measure gaps, if there are any.
  void record(const State<Dim>& s, double time, FaceContacts<Dim>* faces, Series& series);

  std::size_t size() const { return probes_.size(); }

  /// What changes as particles are stored in another order.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(where_, support_);
    for (Follower& f : followers_) archive(f.pairs, f.held_value);
  }

 private:
  struct Follower {
    std::vector<PointWeight> at,
        to;  // material points, or the particles of a body with their share of its mass
    std::vector<std::pair<int, int>> pairs;  // gap: stored particles of the two bodies within the support
    double held_value = 0;                   // of what is looked at between rebuilds only, m
  };

  std::vector<PointWeight> point(const InitialParticles& initial, const Probe& probe, const Point& at,
                                 double reach) const;
  void find_close_pairs(const State<Dim>& s, const Probe& probe, Follower& f) const;
  double mirror_asymmetry(const State<Dim>& s, const Probe& probe) const;
  double value(const State<Dim>& s, const Probe& probe, const Follower& f, FaceContacts<Dim>* faces) const;
  Vec<double, Dim> place(const State<Dim>& s, const std::vector<PointWeight>& point) const {
    Vec<double, Dim> x{};
    for (const PointWeight& w : point) x += w.weight * s.x[where_[w.particle]];
    return x;
  }

  std::vector<Probe> probes_;
  std::vector<Follower> followers_;
  std::vector<int> where_;        // [id] place in the solver's order
  std::vector<int> first_;        // first particle of each body
  std::vector<int> body_;         // [id]
  std::vector<double> diameter_;  // [id] m
  double support_ = 0;
};

template <int Dim>
ProbeRecorder<Dim>::ProbeRecorder(const Scene& scene, const InitialParticles& initial, double reach)
    : probes_(scene.probes), first_(initial.first), body_(initial.body) {
  for (double V0 : initial.V0) diameter_.push_back(std::pow(V0, 1.0 / Dim));
  for (const Probe& probe : probes_) {
    Follower f;
    const int body = probe.bodies.empty() ? 0 : probe.bodies[0];
    if (probe.kind == Probe::Kind::mean_velocity) {
      double total = 0;
      for (int i = first_[body]; i < first_[body + 1]; ++i) total += initial.V0[i];
      for (int i = first_[body]; i < first_[body + 1]; ++i) f.at.push_back({i, initial.V0[i] / total});
    } else if (probe.kind != Probe::Kind::gap && probe.kind != Probe::Kind::mirror_asymmetry) {
      f.at = point(initial, probe, probe.at, reach);
      if (probe.kind == Probe::Kind::distance) f.to = point(initial, probe, probe.to, reach);
    }
    followers_.push_back(std::move(f));
  }
}

template <int Dim>
auto ProbeRecorder<Dim>::point(const InitialParticles& initial, const Probe& probe, const Point& at,
                               double reach) const -> std::vector<PointWeight> {
  const int body = probe.bodies[0];
  std::vector<PointWeight> point = material_point(initial.x, first_[body], first_[body + 1], at, reach, Dim);
  if (point.empty())
    throw SceneError("probe." + probe.name,
                     "the probe '" + probe.name + "' has too few particles of its body around its point");
  return point;
}

template <int Dim>
void ProbeRecorder<Dim>::rebuilt(const State<Dim>& s, double support) {
  support_ = support;
  where_.resize(s.size());
  for (int i = 0; i < s.size(); ++i) where_[s.id[i]] = i;
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    if (probes_[k].kind == Probe::Kind::gap) find_close_pairs(s, probes_[k], followers_[k]);
    if (probes_[k].kind == Probe::Kind::mirror_asymmetry)
      followers_[k].held_value = mirror_asymmetry(s, probes_[k]);
  }
}

template <int Dim>
void ProbeRecorder<Dim>::find_close_pairs(const State<Dim>& s, const Probe& probe, Follower& f) const {
  f.pairs.clear();
  for (int id = first_[probe.bodies[0]]; id < first_[probe.bodies[0] + 1]; ++id) {
    const int i = where_[id];
    for (int p = lanes * s.neighbors.begin[i]; p < lanes * s.neighbors.begin[i + 1]; ++p) {
      const int j = s.neighbors.j[p];
      if (body_[s.id[j]] == probe.bodies[1]) f.pairs.emplace_back(i, j);
    }
  }
}

template <int Dim>
double ProbeRecorder<Dim>::mirror_asymmetry(const State<Dim>& s, const Probe& probe) const {
  const int a = first_[probe.bodies[0]], b = first_[probe.bodies[1]];
  const int n = first_[probe.bodies[0] + 1] - a;
  double greatest2 = 0;
  for (int k = 0; k < n; ++k) {
    Vec<double, Dim> d = s.x[where_[a + k]];
    Vec<double, Dim> image = s.x[where_[b + k]];
    image[probe.axis] = 2 * probe.at[probe.axis] - image[probe.axis];
    d -= image;
    greatest2 = std::max(greatest2, dot(d, d));
  }
  return std::sqrt(greatest2);
}

template <int Dim>
double ProbeRecorder<Dim>::value(const State<Dim>& s, const Probe& probe, const Follower& f,
                                 FaceContacts<Dim>* faces) const {
  switch (probe.kind) {
    case Probe::Kind::displacement:
      return place(s, f.at)[probe.axis] - probe.at[probe.axis];
    case Probe::Kind::position:
      return place(s, f.at)[probe.axis];
    case Probe::Kind::distance: {
      const Vec<double, Dim> d = place(s, f.to) - place(s, f.at);
      return std::sqrt(dot(d, d));
    }
    case Probe::Kind::mean_velocity: {
      double v = 0;
      for (const PointWeight& w : f.at) v += w.weight * s.v[where_[w.particle]][probe.axis];
      return v;
    }
    case Probe::Kind::gap: {
      if (faces) return faces->gap(s, probe.bodies[0], probe.bodies[1]);
      double least = support_ - diameter_[first_[probe.bodies[0]]];  // at least this: nothing is in reach
      for (const auto& [i, j] : f.pairs) {
        const Vec<double, Dim> d = s.x[i] - s.x[j];
        least = std::min(least, std::sqrt(dot(d, d)) - 0.5 * (diameter_[s.id[i]] + diameter_[s.id[j]]));
      }
      return least;
    }
    case Probe::Kind::mirror_asymmetry:
      return f.held_value;
  }
  return 0;
}

template <int Dim>
void ProbeRecorder<Dim>::record(const State<Dim>& s, double time, FaceContacts<Dim>* faces, Series& series) {
  if (probes_.empty()) return;
  series.value.resize(probes_.size());
  series.time.push_back(time);
  for (std::size_t k = 0; k < probes_.size(); ++k)
    series.value[k].push_back(value(s, probes_[k], followers_[k], faces));
}

}  // namespace taut::inline TAUT_ISA
