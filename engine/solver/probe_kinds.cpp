#include "engine/solver/probe_kinds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <string>

#include <fmt/core.h>

#include "engine/contact/face_contacts.hpp"
#include "engine/contact/facet_contacts.hpp"
#include "engine/error.hpp"
#include "engine/layout/element_nodes.hpp"

namespace taut {
namespace {

using Points = std::vector<PointWeight>;

[[noreturn]] void refuse(const Probe& probe, const std::string& reason) {
  throw SceneError("probe." + probe.name, fmt::format("the probe '{}' {}", probe.name, reason));
}

Points point(const ProbeSetUp& in, const Probe& probe, const Point& at) {
  const auto& [scene, initial, reach] = in;
  const int body = probe.bodies[0], begin = initial.first[body], end = initial.first[body + 1];
  constexpr double farthest = 1.5;  // spacings
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = begin; i < end; ++i) {
    double squared = 0;
    for (int k = 0; k < scene.dim; ++k) squared += std::pow(initial.x[i][k] - at[k], 2);
    nearest = std::min(nearest, std::sqrt(squared) / scene.spacing);
  }
  if (nearest > farthest)
    throw SceneError(
        "probe." + probe.name,
        fmt::format(
            "the point of the probe '{}' is outside its body, more than 1.5 spacings from the nearest particle",
            probe.name));
  if (initial.mesh.order > 0)
    if (Points found = point_in_element(initial, body, at); !found.empty()) return found;
  Points found = material_point(initial.x, begin, end, at, reach, scene, body);
  if (found.empty()) refuse(probe, "has too few particles of its body around its point");
  return found;
}

Surroundings surroundings(const ProbeSetUp& in, int body, const std::vector<unsigned char>& driven) {
  const auto& [scene, initial, reach] = in;
  return {initial.x,
          initial.clamped,
          driven,
          initial.material,
          initial.first[body],
          initial.first[body + 1],
          reach,
          link_of_neighbors * scene.spacing,
          scene.dim};
}

Points moving_point(const ProbeSetUp& in, const Probe& probe, const Point& at) {
  const InitialParticles& initial = in.initial;
  std::vector<int> motion_group(initial.clamped.size());
  for (std::size_t id = 0; id < motion_group.size(); ++id)
    motion_group[id] = initial.clamped[id] ? -1 : initial.drive[id] + 1;
  Points by_all = point(in, probe, at);
  const int body = probe.bodies[0];
  if (in.scene.bodies[body].on_boundary || initial.mesh.order > 0) return by_all;
  const std::vector<unsigned char> driven = initial.driven();
  return point_of_motion(std::move(by_all), surroundings(in, body, driven), motion_group, at);
}

template <int Dim>
Vec<double, Dim> offset(const InitialParticles& initial, const Points& point, const Point& at) {
  Vec<double, Dim> way{};
  if (point.size() != 1) return way;
  for (int k = 0; k < Dim; ++k) way[k] = at[k] - initial.x[point.front().particle][k];
  return way;
}

template <int Dim>
void follow_point(ProbeFollower<Dim>& f, const ProbeSetUp& in) {
  f.at = moving_point(in, f.probe, f.probe.at);
  f.beside = offset<Dim>(in.initial, f.at, f.probe.at);
}
template <int Dim>
void follow_two_points(ProbeFollower<Dim>& f, const ProbeSetUp& in) {
  follow_point(f, in);
  f.to = moving_point(in, f.probe, f.probe.to);
  f.to_beside = offset<Dim>(in.initial, f.to, f.probe.to);
}
template <int Dim>
void follow_body(ProbeFollower<Dim>& f, const ProbeSetUp& in) {
  const int body = f.probe.bodies[0];
  for (int i = in.initial.first[body]; i < in.initial.first[body + 1]; ++i) f.at.push_back({i, 1});
}

template <int Dim>
void follow_stress(ProbeFollower<Dim>& f, const ProbeSetUp& in) {
  Points by_all = point(in, f.probe, f.probe.at);
  const std::vector<unsigned char> driven = in.initial.driven();
  f.at = point_of_stress(std::move(by_all), surroundings(in, f.probe.bodies[0], driven), f.probe.at);
  if (f.at.empty()) refuse(f.probe, "has too few free particles around its point");
}

template <int Dim>
void follow_constrained(ProbeFollower<Dim>& f, const ProbeSetUp& in) {
  const InitialParticles& initial = in.initial;
  const Probe& probe = f.probe;
  const int body = probe.bodies[0];
  std::vector<unsigned char> held(initial.x.size());
  for (int id = initial.first[body]; id < initial.first[body + 1]; ++id)
    held[id] = initial.clamped[id] || initial.drive[id] >= 0 ||
               (!initial.guided.empty() && (initial.guided[id] >> probe.axis & 1));
  const bool by_cell = probe.where && initial.mesh.order > 0;
  const std::vector<double> share =
      by_cell ? shares_in_region(probe.where, initial, held) : std::vector<double>{};
  for (int id = initial.first[body]; id < initial.first[body + 1]; ++id) {
    if (!held[id]) continue;
    const double weight = by_cell ? share[id] : !probe.where || probe.where(initial.cell(id)) != 0;
    if (weight > 0) f.at.push_back({id, weight});
  }
  if (f.at.empty())
    refuse(probe, fmt::format("has no reaction: no particle of its {} is held or driven along its component",
                              probe.where ? "region" : "body"));
}

/// In two bodies, particles of equal index are images; in one body, particles at mirrored positions.
template <int Dim>
void follow_images(ProbeFollower<Dim>& f, const ProbeSetUp& in) {
  const auto& [scene, initial, reach] = in;
  const Probe& probe = f.probe;
  const int a = probe.bodies[0], b = probe.bodies[1];
  const int of_a = initial.first[a + 1] - initial.first[a], of_b = initial.first[b + 1] - initial.first[b];
  f.image.resize(of_a);
  std::iota(f.image.begin(), f.image.end(), initial.first[b]);
  if (of_a != of_b)
    refuse(probe,
           fmt::format("compares two bodies that are not images of each other: they have {} and {} particles",
                       of_a, of_b));
  if (a != b) return;
  using Cell = std::array<long, 3>;
  // by round-off, an image may lie in an adjacent cell
  const auto cell = [side = 0.25 * scene.spacing](const Point& x) {
    return Cell{std::lround(x[0] / side), std::lround(x[1] / side), std::lround(x[2] / side)};
  };
  std::map<Cell, int> at;
  for (const int id : f.image) at[cell(initial.cell(id))] = id;
  for (int& id : f.image) {
    Point mirrored = initial.cell(id);
    mirrored[probe.axis] = 2 * probe.at[probe.axis] - mirrored[probe.axis];
    Cell near = cell(mirrored);
    auto found = at.find(near);
    for (const long step : {-1, 2})
      if (found == at.end()) near[probe.axis] += step, found = at.find(near);
    if (found == at.end())
      refuse(probe,
             "needs a body that is symmetric about a plane through the origin: "
             "its particles are not mirror images of each other at the start");
    id = found->second;
  }
}

template <int Dim>
void find_close_pairs(ProbeFollower<Dim>& f, const ProbeView<Dim>& now, const Neighbors& neighbors) {
  f.pairs.clear();
  for (int id = now.first[f.probe.bodies[0]]; id < now.first[f.probe.bodies[0] + 1]; ++id) {
    const int i = now.where[id];
    for (int p = lanes * neighbors.begin[i]; p < lanes * neighbors.begin[i + 1]; ++p) {
      const int j = neighbors.j[p];
      if (now.s.body[j] == f.probe.bodies[1]) f.pairs.emplace_back(i, j);
    }
  }
}

template <int Dim>
void update_mirror_asymmetry(ProbeFollower<Dim>& f, const ProbeView<Dim>& now) {
  const Probe& probe = f.probe;
  const int a = now.first[probe.bodies[0]];
  double greatest2 = 0;
  for (int k = 0; k < static_cast<int>(f.image.size()); ++k) {
    Vec<double, Dim> d = now.s.x[now.where[a + k]];
    Vec<double, Dim> image = now.s.x[now.where[f.image[k]]];
    image[probe.axis] = 2 * probe.at[probe.axis] - image[probe.axis];
    d -= image;
    greatest2 = std::max(greatest2, dot(d, d));
  }
  f.last = std::sqrt(greatest2);
}

template <int Dim>
Vec<double, Dim> place(const ProbeFollower<Dim>& f, const ProbeView<Dim>& now) {
  return now.place(f.at) + f.beside;
}

template <int Dim>
double mean(const ProbeFollower<Dim>& f, const ProbeView<Dim>& now, const std::vector<Vec<double, Dim>>& of) {
  double moment = 0, mass = 0;
  for (const PointWeight& w : f.at) {
    const int i = now.where[w.particle];
    moment += now.s.m[i] * of[i][f.probe.axis], mass += now.s.m[i];
  }
  return moment / mass;
}

template <int Dim>
double distance(ProbeFollower<Dim>& f, const ProbeStep<Dim>& now) {
  const Vec<double, Dim> d = (now.place(f.to) + f.to_beside) - place(f, now);
  return std::sqrt(dot(d, d));
}

template <int Dim>
double velocity(ProbeFollower<Dim>& f, const ProbeStep<Dim>& now) {
  double v = 0;
  for (const PointWeight& w : f.at) v += w.weight * now.s.v[now.where[w.particle]][f.probe.axis];
  return v;
}

template <int Dim>
double greatest_position(ProbeFollower<Dim>& f, const ProbeStep<Dim>& now) {
  double greatest = -std::numeric_limits<double>::infinity();
  for (const PointWeight& w : f.at)
    greatest = std::max(greatest, now.s.x[now.where[w.particle]][f.probe.axis]);
  return greatest;
}

template <int Dim>
double gap(ProbeFollower<Dim>& f, const ProbeStep<Dim>& now) {
  const std::vector<int>& bodies = f.probe.bodies;
  if (ContactsOfFaces<Dim>* const faces = now.source.faces()) return faces->gap(now.s, bodies[0], bodies[1]);
  const auto& diameter = now.diameter;
  double least = now.support - 0.5 * (diameter[now.first[bodies[0]]] + diameter[now.first[bodies[1]]]);
  for (const auto& [i, j] : f.pairs) {
    const Vec<double, Dim> d = now.s.x[i] - now.s.x[j];
    least = std::min(least, std::sqrt(dot(d, d)) - 0.5 * (diameter[now.s.id[i]] + diameter[now.s.id[j]]));
  }
  return least;
}

template <int Dim>
double mirror_asymmetry(ProbeFollower<Dim>& f, const ProbeStep<Dim>& now) {
  if (now.evaluates_expensive) update_mirror_asymmetry<Dim>(f, now);
  return f.last;
}

/// Angle from the initial direction, −π to π, right-handed.
template <int Dim>
double angle(const ProbeFollower<Dim>& f, const ProbeStep<Dim>& now) {
  const Point& a = f.probe.turns_about;
  const Vec<double, Dim> at = place<Dim>(f, now);
  Point x{};
  for (int k = 0; k < Dim; ++k) x[k] = at[k];
  const auto dot3 = [](const Point& u, const Point& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
  const auto& X = f.probe.at;
  const Point normal{a[1] * X[2] - a[2] * X[1], a[2] * X[0] - a[0] * X[2],
                     a[0] * X[1] - a[1] * X[0]};  // a × X
  return std::atan2(dot3(normal, x), dot3(X, x) - dot3(a, X) * dot3(a, x));
}
template <int Dim>
double turn(ProbeFollower<Dim>& f, const ProbeStep<Dim>& now) {
  // a step turns by less than half a turn
  f.last = f.last + std::remainder(angle(f, now) - f.last, 2 * std::numbers::pi);
  return f.last;
}

double part_of(const StressTensor& stress, StressPart part) {
  const double p = -(stress.xx + stress.yy + stress.zz) / 3;
  const auto squared = [](double a) { return a * a; };
  switch (part) {
    case StressPart::xx:
      return stress.xx;
    case StressPart::yy:
      return stress.yy;
    case StressPart::zz:
      return stress.zz;
    case StressPart::xy:
      return stress.xy;
    case StressPart::xz:
      return stress.xz;
    case StressPart::yz:
      return stress.yz;
    case StressPart::pressure:
      return p;
    case StressPart::von_mises:
      return std::sqrt(1.5 * (squared(stress.xx + p) + squared(stress.yy + p) + squared(stress.zz + p)) +
                       3 * (squared(stress.xy) + squared(stress.xz) + squared(stress.yz)));
  }
  return 0;
}
template <int Dim>
double stress(ProbeFollower<Dim>& f, const ProbeStep<Dim>& now) {
  StressTensor sum;
  for (const PointWeight& w : f.at) {
    const StressTensor of_particle = now.shown->stress(w.particle);
    for (const auto part : {&StressTensor::xx, &StressTensor::yy, &StressTensor::zz, &StressTensor::xy,
                            &StressTensor::xz, &StressTensor::yz})
      sum.*part += w.weight * of_particle.*part;
  }
  return part_of(sum, f.probe.part);
}

template <int Dim>
double reaction(ProbeFollower<Dim>& f, const ProbeStep<Dim>& now) {
  double sum = 0;
  for (const PointWeight& w : f.at)
    sum += w.weight * now.source.reaction(now.where[w.particle])[f.probe.axis];
  return sum;
}

}  // namespace

template <int Dim>
const ProbeRow<Dim>& probe_row(const Probe& probe) {
  using Kind = Probe::Kind;
  using F = ProbeFollower<Dim>;
  using Now = ProbeStep<Dim>;
  static constexpr ProbeRow<Dim> rows[] = {
      {Kind::displacement, follow_point,
       [](F& f, const Now& now) { return place<Dim>(f, now)[f.probe.axis] - f.probe.at[f.probe.axis]; }},
      {Kind::position, follow_point, [](F& f, const Now& now) { return place<Dim>(f, now)[f.probe.axis]; }},
      {Kind::velocity, follow_point, velocity},
      {Kind::distance, follow_two_points, distance},
      {Kind::mean_velocity, follow_body, [](F& f, const Now& now) { return mean<Dim>(f, now, now.s.v); }},
      {Kind::mean_position, follow_body, [](F& f, const Now& now) { return mean<Dim>(f, now, now.s.x); }},
      {Kind::greatest_position, follow_body, greatest_position},
      {Kind::gap, nullptr, gap, find_close_pairs},
      {Kind::mirror_asymmetry, follow_images, mirror_asymmetry,
       [](F& f, const ProbeView<Dim>& now, const Neighbors&) { update_mirror_asymmetry(f, now); }},
      {Kind::turn, follow_point, turn},
      {Kind::stress, follow_stress, stress, nullptr, true},
      {Kind::reaction, follow_constrained, reaction},
      {Kind::contact_force, nullptr,
       [](F& f, const Now& now) { return now.source.contact_force(f.probe, now.dt)[f.probe.axis]; }},
      {Kind::expression, nullptr, [](F& f, const Now& now) { return f.probe.value(now.before, now.time); }},
  };
  const auto row = std::ranges::find(rows, probe.kind, &ProbeRow<Dim>::kind);
  if (row == std::end(rows)) refuse(probe, fmt::format("has the unknown kind '{}'", probe.kind.name));
  return *row;
}

template const ProbeRow<2>& probe_row(const Probe&);
template const ProbeRow<3>& probe_row(const Probe&);

}  // namespace taut
