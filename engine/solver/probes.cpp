// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/solver/probes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <string>

#include "engine/error.hpp"

namespace taut::inline TAUT_ISA {

template <int Dim>
ProbeRecorder<Dim>::ProbeRecorder(const Scene& scene, const InitialParticles& initial, double support)
    : probes_(scene.probes), first_(initial.first) {
  const double reach = reach_of_points(support, scene.spacing);
  for (int i = 0; i < initial.size(); ++i)
    diameter_.push_back(std::pow(initial.V0[i] / initial.inside[i], 1.0 / Dim));
  for (const Probe& probe : probes_) {
    Follower f;
    const int body = probe.bodies.empty() ? 0 : probe.bodies[0];
    if (of_whole_body(probe.kind)) {
      for (int i = first_[body]; i < first_[body + 1]; ++i) f.at.push_back({i, 1});
    } else if (probe.kind == Probe::Kind::mirror_asymmetry) {
      f.image = images(scene, initial, probe);
    } else if (probe.kind == Probe::Kind::stress) {
      f.at = point_of_stress(scene, initial, probe, reach);
      for (const PointWeight& w : f.at) stressed_.push_back(w.particle);
    } else if (probe.kind == Probe::Kind::reaction) {
      f.at = held_particles(initial, probe);
    } else if (of_a_point(probe.kind)) {
      f.at = point_of_motion(scene, initial, probe, probe.at, reach);
      f.beside = beside(initial, f.at, probe.at);
      if (probe.kind == Probe::Kind::distance) {
        f.to = point_of_motion(scene, initial, probe, probe.to, reach);
        f.to_beside = beside(initial, f.to, probe.to);
      }
    }
    followers_.push_back(std::move(f));
  }
}

template <int Dim>
auto ProbeRecorder<Dim>::point(const Scene& scene, const InitialParticles& initial, const Probe& probe,
                               const Point& at, double reach) const -> std::vector<PointWeight> {
  const int body = probe.bodies[0];
  constexpr double farthest = 1.5;  // spacings: beyond the corner of a face that lies across the layout
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = first_[body]; i < first_[body + 1]; ++i) {
    double squared = 0;
    for (int k = 0; k < Dim; ++k) squared += std::pow(initial.x[i][k] - at[k], 2);
    nearest = std::min(nearest, std::sqrt(squared) / scene.spacing);
  }
  if (nearest > farthest)
    throw SceneError("probe." + probe.name,
                     "the point of the probe '" + probe.name +
                         "' is outside its body, more than 1.5 spacings from the nearest particle");
  std::vector<PointWeight> point =
      material_point(initial.x, first_[body], first_[body + 1], at, reach, scene, body);
  if (point.empty())
    throw SceneError("probe." + probe.name,
                     "the probe '" + probe.name + "' has too few particles of its body around its point");
  return point;
}

template <int Dim>
auto ProbeRecorder<Dim>::beside(const InitialParticles& initial, const std::vector<PointWeight>& point,
                                const Point& at) -> Vec<double, Dim> {
  Vec<double, Dim> way{};
  if (point.size() != 1) return way;  // several are where they say
  for (int k = 0; k < Dim; ++k) way[k] = at[k] - initial.x[point.front().particle][k];
  return way;
}

template <int Dim>
auto ProbeRecorder<Dim>::point_of_motion(const Scene& scene, const InitialParticles& initial,
                                         const Probe& probe, const Point& at, double reach) const
    -> std::vector<PointWeight> {
  const int body = probe.bodies[0];
  std::vector<int> moves_with(initial.held.size());
  for (std::size_t id = 0; id < moves_with.size(); ++id)
    moves_with[id] = initial.held[id] ? -1 : initial.drive[id] + 1;
  std::vector<PointWeight> by_all = point(scene, initial, probe, at, reach);
  if (scene.bodies[body].on_boundary) return by_all;  // on a particle it is that particle
  return taut::point_of_motion(std::move(by_all),
                               {initial.x, initial.held, initial.driven(), initial.material, first_[body],
                                first_[body + 1], reach, link_of_neighbors * scene.spacing, scene.dim},
                               moves_with, at);
}

template <int Dim>
auto ProbeRecorder<Dim>::point_of_stress(const Scene& scene, const InitialParticles& initial,
                                         const Probe& probe, double reach) const -> std::vector<PointWeight> {
  const int body = probe.bodies[0];
  std::vector<PointWeight> near =
      taut::point_of_stress(point(scene, initial, probe, probe.at, reach),
                            {initial.x, initial.held, initial.driven(), initial.material, first_[body],
                             first_[body + 1], reach, link_of_neighbors * scene.spacing, scene.dim},
                            probe.at);
  if (near.empty())
    throw SceneError("probe." + probe.name,
                     "the probe '" + probe.name + "' has too few free particles around its point");
  return near;
}

template <int Dim>
auto ProbeRecorder<Dim>::held_particles(const InitialParticles& initial, const Probe& probe) const
    -> std::vector<PointWeight> {
  std::vector<PointWeight> found;
  for (int id = first_[probe.bodies[0]]; id < first_[probe.bodies[0] + 1]; ++id) {
    const bool guided = !initial.guided.empty() && (initial.guided[id] >> probe.axis & 1);
    if (!initial.held[id] && initial.drive[id] < 0 && !guided) continue;
    if (!probe.where || probe.where(initial.cell(id)) != 0) found.push_back({id, 1});
  }
  if (found.empty())
    throw SceneError("probe." + probe.name,
                     "the probe '" + probe.name + "' has no reaction: no particle of its " +
                         (probe.where ? "region" : "body") + " is held or driven along its component");
  return found;
}

template <int Dim>
void ProbeRecorder<Dim>::rebuilt(const Particles<Dim>& s, const Neighbors& neighbors, double support) {
  support_ = support;
  where_ = s.places_of_ids();
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    if (probes_[k].kind == Probe::Kind::gap) find_close_pairs(s, neighbors, probes_[k], followers_[k]);
    if (probes_[k].kind == Probe::Kind::mirror_asymmetry)
      followers_[k].held_value = mirror_asymmetry(s, probes_[k], followers_[k]);
  }
}

template <int Dim>
void ProbeRecorder<Dim>::find_close_pairs(const Particles<Dim>& s, const Neighbors& neighbors,
                                          const Probe& probe, Follower& f) const {
  f.pairs.clear();
  for (int id = first_[probe.bodies[0]]; id < first_[probe.bodies[0] + 1]; ++id) {
    const int i = where_[id];
    for (int p = lanes * neighbors.begin[i]; p < lanes * neighbors.begin[i + 1]; ++p) {
      const int j = neighbors.j[p];
      if (s.body[j] == probe.bodies[1]) f.pairs.emplace_back(i, j);
    }
  }
}

/// Of two bodies the particles follow each other alike; in one the image of each is where the mirror has it.
template <int Dim>
std::vector<int> ProbeRecorder<Dim>::images(const Scene& scene, const InitialParticles& initial,
                                            const Probe& probe) {
  const int a = probe.bodies[0], b = probe.bodies[1];
  std::vector<int> images(initial.first[a + 1] - initial.first[a]);
  std::iota(images.begin(), images.end(), initial.first[b]);
  if (initial.first[b + 1] - initial.first[b] != static_cast<int>(images.size()))
    throw SceneError("probe." + probe.name,
                     "the probe '" + probe.name +
                         "' compares two bodies that are not images of each other: they have " +
                         std::to_string(images.size()) + " and " +
                         std::to_string(initial.first[b + 1] - initial.first[b]) + " particles");
  if (a != b) return images;
  using Cell = std::array<long, 3>;
  // a quarter of a spacing: mirrored places are found in the same cell or, by round-off, in the next one
  const auto cell = [side = 0.25 * scene.spacing](const Point& x) {
    return Cell{std::lround(x[0] / side), std::lround(x[1] / side), std::lround(x[2] / side)};
  };
  std::map<Cell, int> at;
  for (const int id : images) at[cell(initial.cell(id))] = id;
  for (int& id : images) {
    Point mirrored = initial.cell(id);
    mirrored[probe.axis] = 2 * probe.at[probe.axis] - mirrored[probe.axis];
    Cell near = cell(mirrored);
    auto found = at.find(near);
    for (const long step : {-1, 2})
      if (found == at.end()) near[probe.axis] += step, found = at.find(near);
    if (found == at.end())
      throw SceneError(
          "probe." + probe.name,
          "the probe '" + probe.name +
              "' needs a symmetric body: its particles are not mirror images of each other at the start");
    id = found->second;
  }
  return images;
}

template <int Dim>
double ProbeRecorder<Dim>::mirror_asymmetry(const Particles<Dim>& s, const Probe& probe,
                                            const Follower& f) const {
  const int a = first_[probe.bodies[0]];
  double greatest2 = 0;
  for (int k = 0; k < static_cast<int>(f.image.size()); ++k) {
    Vec<double, Dim> d = s.x[where_[a + k]];
    Vec<double, Dim> image = s.x[where_[f.image[k]]];
    image[probe.axis] = 2 * probe.at[probe.axis] - image[probe.axis];
    d -= image;
    greatest2 = std::max(greatest2, dot(d, d));
  }
  return std::sqrt(greatest2);
}

template <int Dim>
double ProbeRecorder<Dim>::mean(const Particles<Dim>& s, const Follower& f,
                                const std::vector<Vec<double, Dim>>& of, int axis) const {
  double moment = 0, mass = 0;
  for (const PointWeight& w : f.at) {
    const int i = where_[w.particle];
    moment += s.m[i] * of[i][axis], mass += s.m[i];
  }
  return moment / mass;
}

/// From where the point is at the start, −π to π, right-handed about the axis.
template <int Dim>
double ProbeRecorder<Dim>::angle(const Particles<Dim>& s, const Probe& probe, const Follower& f) const {
  const Point& a = probe.turns_about;
  const Vec<double, Dim> now = place(s, f.at) + f.beside;
  Point x{};
  for (int k = 0; k < Dim; ++k) x[k] = now[k];
  const auto dot3 = [](const Point& u, const Point& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
  const auto& X = probe.at;
  const Point normal{a[1] * X[2] - a[2] * X[1], a[2] * X[0] - a[0] * X[2],
                     a[0] * X[1] - a[1] * X[0]};  // a × X
  return std::atan2(dot3(normal, x), dot3(X, x) - dot3(a, X) * dot3(a, x));
}

template <int Dim>
double ProbeRecorder<Dim>::stress(const Snapshot& shown, const Probe& probe, const Follower& f) const {
  StressTensor sum;
  for (const PointWeight& w : f.at) {
    const StressTensor one = shown.stress(w.particle);
    for (const auto part : {&StressTensor::xx, &StressTensor::yy, &StressTensor::zz, &StressTensor::xy,
                            &StressTensor::xz, &StressTensor::yz})
      sum.*part += w.weight * one.*part;
  }
  const double p = -(sum.xx + sum.yy + sum.zz) / 3;
  const auto squared = [](double a) { return a * a; };
  switch (probe.part) {
    case StressPart::xx:
      return sum.xx;
    case StressPart::yy:
      return sum.yy;
    case StressPart::zz:
      return sum.zz;
    case StressPart::xy:
      return sum.xy;
    case StressPart::xz:
      return sum.xz;
    case StressPart::yz:
      return sum.yz;
    case StressPart::pressure:
      return p;
    case StressPart::von_mises:
      return std::sqrt(1.5 * (squared(sum.xx + p) + squared(sum.yy + p) + squared(sum.zz + p)) +
                       3 * (squared(sum.xy) + squared(sum.xz) + squared(sum.yz)));
  }
  return 0;
}

/// Of a reaction or a contact over the last step, of `dt`; 0 at the start.
template <int Dim>
double ProbeRecorder<Dim>::force(const Probe& probe, const Follower& f, double dt,
                                 ProbeSource<Dim>& source) const {
  if (probe.kind == Probe::Kind::contact_force) return source.contact_force(probe, dt)[probe.axis];
  double sum = 0;
  for (const PointWeight& w : f.at) sum += source.reaction(where_[w.particle])[probe.axis];
  return sum;
}

template <int Dim>
double ProbeRecorder<Dim>::value(const Particles<Dim>& s, const Probe& probe, const Follower& f,
                                 ProbeSource<Dim>& source) const {
  switch (probe.kind) {
    case Probe::Kind::displacement:
      return (place(s, f.at) + f.beside)[probe.axis] - probe.at[probe.axis];
    case Probe::Kind::position:
      return (place(s, f.at) + f.beside)[probe.axis];
    case Probe::Kind::mean_position:
      return mean(s, f, s.x, probe.axis);
    case Probe::Kind::mean_velocity:
      return mean(s, f, s.v, probe.axis);
    case Probe::Kind::distance: {
      const Vec<double, Dim> d = (place(s, f.to) + f.to_beside) - (place(s, f.at) + f.beside);
      return std::sqrt(dot(d, d));
    }
    case Probe::Kind::velocity: {
      double v = 0;
      for (const PointWeight& w : f.at) v += w.weight * s.v[where_[w.particle]][probe.axis];
      return v;
    }
    case Probe::Kind::greatest_position: {
      double greatest = -std::numeric_limits<double>::infinity();
      for (const PointWeight& w : f.at) greatest = std::max(greatest, s.x[where_[w.particle]][probe.axis]);
      return greatest;
    }
    case Probe::Kind::gap: {
      if (ContactsOfFaces<Dim>* const faces = source.faces())
        return faces->gap(s, probe.bodies[0], probe.bodies[1]);
      // at least this: nothing is in reach
      double least =
          support_ - 0.5 * (diameter_[first_[probe.bodies[0]]] + diameter_[first_[probe.bodies[1]]]);
      for (const auto& [i, j] : f.pairs) {
        const Vec<double, Dim> d = s.x[i] - s.x[j];
        least = std::min(least, std::sqrt(dot(d, d)) - 0.5 * (diameter_[s.id[i]] + diameter_[s.id[j]]));
      }
      return least;
    }
    case Probe::Kind::mirror_asymmetry:
      return f.held_value;
    case Probe::Kind::turn:
      // the whole turns so far are in the value before, which is less than half a turn away
      return f.held_value + std::remainder(angle(s, probe, f) - f.held_value, 2 * std::numbers::pi);
    default:  // what `record` knows more for
      return 0;
  }
}

template <int Dim>
void ProbeRecorder<Dim>::record(const Particles<Dim>& s, double time, ProbeSource<Dim>& source,
                                Series& series) {
  const double dt = series.time.empty() ? 0 : time - series.time.back();
  series.value.resize(probes_.size());
  series.time.push_back(time);
  // a body that meets nothing may never be searched anew
  constexpr std::size_t now_and_then = 32;
  const bool look = series.time.size() % now_and_then == 1;
  const Snapshot* shown = stressed_.empty() ? nullptr : &source.shown(stored(stressed_));
  std::vector<double> row;
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    const Probe& probe = probes_[k];
    if (look && probe.kind == Probe::Kind::mirror_asymmetry && probe.bodies[0] == probe.bodies[1])
      followers_[k].held_value = mirror_asymmetry(s, probe, followers_[k]);
    double now = 0;
    if (probe.kind == Probe::Kind::stress)
      now = stress(*shown, probe, followers_[k]);
    else if (probe.kind == Probe::Kind::expression)
      now = probe.value(row, time);
    else if (!is_force(probe.kind))
      now = value(s, probe, followers_[k], source);
    else if (dt > 0)
      now = force(probe, followers_[k], dt, source);
    series.value[k].push_back(now);
    row.push_back(now);
    if (probes_[k].kind == Probe::Kind::turn) followers_[k].held_value = now;
  }
}

template class ProbeRecorder<2>;
template class ProbeRecorder<3>;

}  // namespace taut::inline TAUT_ISA
