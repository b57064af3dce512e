#include "engine/solver/common.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/core/median.hpp"
#include "engine/error.hpp"

namespace taut {

template <int Dim>
Common<Dim>::Common(const SolverInput& input, double support)
    : constants(input.constants),
      initial(input.initial),
      contact(input),
      external(input.scene, input.initial),
      probes(input.scene, input.initial, support),
      team(input.threads) {
  run.threads = input.threads;
  run.support = support;
  run.keeps_neighbors = input.keeps_neighbors;
  const auto point = [](const Point& p) {
    V v;
    for (int k = 0; k < Dim; ++k) v[k] = p[k];
    return v;
  };
  Particles<Dim>& p = particles;
  for (int i = 0; i < initial.size(); ++i) {
    p.x.push_back(point(initial.x[i]));
    p.v.push_back(external.drives.moves(i) ? external.drives.velocity(i) : point(initial.v[i]));
    p.m.push_back(input.materials[initial.material[i]].rho0 * initial.V0[i]);
    p.mobile.push_back(initial.clamped[i] ? 0 : 1);
    vmax = std::max(vmax, std::sqrt(dot(p.v[i], p.v[i])));
  }
  p.id.resize(p.x.size());
  std::iota(p.id.begin(), p.id.end(), 0);
  p.body = initial.body;
  p.material = initial.material;
}

template <int Dim>
void Common<Dim>::go_to_start() {
  if (initial.start.empty()) return;
  for (int i = 0; i < size(); ++i)
    for (int k = 0; k < Dim; ++k) particles.x[i][k] = initial.start[particles.id[i]][k];
}

template <int Dim>
Kick<Dim> Common<Dim>::kick(double dt, double t) {
  external.set_time(dt, t, particles);
  const auto act = [](void* common, int i, double step, V& v) {
    Common& own = *static_cast<Common*>(common);
    own.external.act(own.particles, i, step, v);
  };
  Particles<Dim>& p = particles;
  return {.dt = dt,
          .size = size(),
          .x = p.x.data(),
          .v = p.v.data(),
          .m = p.m.data(),
          .mobile = p.mobile.data(),
          .contact = contact.acting() ? &contact.force(0) : nullptr,
          .impulse = external.reactions.active() ? external.reactions.impulses() : nullptr,
          .outside = this,
          .act = external.active() ? +act : nullptr};
}

namespace {

/// Component-wise median velocity of each body, m/s.
template <int Dim>
std::vector<Vec<double, Dim>> middle_velocities(const Particles<Dim>& s, int bodies) {
  std::vector<Vec<double, Dim>> middle(bodies);
  std::vector<double> v(s.v.size());
  for (int body = 0; body < bodies; ++body) {
    for (int k = 0; k < Dim; ++k) {
      std::size_t count = 0;
      for (int i = 0; i < s.size(); ++i)
        if (s.body[i] == body && std::isfinite(s.v[i][k])) v[count++] = s.v[i][k];
      if (count > 0) middle[body][k] = median({v.data(), count});
    }
  }
  return middle;
}

}  // namespace

template <int Dim>
void Common<Dim>::throw_if_diverged() const {
  const double limit = greatest_mach_number * constants.c0,
               of_bodies = greatest_mach_number_of_bodies * constants.c0;
  const std::vector<V> middle = middle_velocities(particles, static_cast<int>(initial.first.size()) - 1);
  int failed_id = size();
  bool of_body = false;
  for (int i = 0; i < size(); ++i) {
    const V relative_velocity = particles.v[i] - middle[particles.body[i]];
    const bool leaves = !(dot(relative_velocity, relative_velocity) <= limit * limit);
    if ((!leaves && dot(particles.v[i], particles.v[i]) <= of_bodies * of_bodies) ||
        particles.id[i] > failed_id)
      continue;
    failed_id = particles.id[i], of_body = !leaves;
  }
  if (failed_id == size()) return;
  const std::string what = of_body
                               ? fmt::format("particle {} and its body are faster than {:g} m/s ({:g} c0)",
                                             failed_id, of_bodies, greatest_mach_number_of_bodies)
                               : fmt::format(
                                     "particle {} is faster than its body by more than {:g} m/s ({:g} c0), "
                                     "or its speed is not a number",
                                     failed_id, limit, greatest_mach_number);
  throw NumericalError(run.steps, run.time, failed_id, "velocity", what);
}

template <int Dim>
double Common<Dim>::fastest() const {
  double fastest2 = 0;
  for (const V& v : particles.v) fastest2 = std::max(fastest2, dot(v, v));
  return std::sqrt(fastest2);
}

template <int Dim>
bool Common<Dim>::are_of_this_scene() const {
  std::vector<bool> seen(size());
  for (int i = 0; i < size(); ++i) {
    const int id = particles.id[i];
    if (!is_below(id, size()) || seen[id]) return false;
    seen[id] = true;
    if (particles.body[i] != initial.body[id] || particles.material[i] != initial.material[id]) return false;
  }
  return true;
}

template <int Dim>
bool Common<Dim>::are_numbers() const {
  for (int i = 0; i < size(); ++i)
    for (int k = 0; k < Dim; ++k)
      if (!std::isfinite(particles.x[i][k]) || !std::isfinite(particles.v[i][k])) return false;
  return true;
}

template <int Dim>
void Common<Dim>::begin_motion(Snapshot& out) const {
  const std::size_t n = size();
  out.dim = Dim;
  out.x.resize(Dim * n), out.v.resize(Dim * n), out.m.resize(n);
  out.time = run.time;
  out.step = run.steps;
  out.contact_energy = contact.energy(particles);
  out.work = external.drives.work() + external.loads.work();
  out.damped = external.loads.damped();
  out.of_walls = contact.of_walls();
}

template <int Dim>
void Common<Dim>::store_motion(Snapshot& out, int i) const {
  const std::size_t id = particles.id[i];
  for (int k = 0; k < Dim; ++k) {
    out.x[id * Dim + k] = particles.x[i][k];
    out.v[id * Dim + k] = particles.v[i][k];
  }
  out.m[id] = particles.m[i];
}

template <int Dim>
void Common<Dim>::begin_snapshot(Snapshot& out) const {
  begin_motion(out);
  out.body_work.assign(initial.first.size() - 1, 0);
  for (int id = 0; id < size(); ++id)
    out.body_work[initial.body[id]] += external.drives.work(id) + external.loads.work(id);
  if (!out.x0.empty()) return;
  const std::size_t n = size();
  out.resize(Dim, n);
  out.body = initial.body;
  out.material = initial.material;
  out.driven = initial.driven();
  for (std::size_t i = 0; i < n; ++i) {
    out.clamped[particles.id[i]] = particles.mobile[i] == 0;
    for (int k = 0; k < Dim; ++k) out.x0[i * Dim + k] = initial.x[i][k];
    out.diameter[i] = std::pow(initial.V0[i], 1.0 / Dim);
  }
}

template <int Dim>
void Common<Dim>::store(Snapshot& out, int i, double rho, double p, const Sym<double, Dim>& s,
                        double s_zz) const {
  store_motion(out, i);
  const std::size_t id = particles.id[i];
  out.rho[id] = rho;
  out.p[id] = p;
  if constexpr (Dim == 2)
    out.set_deviator(id, {s(0, 0), s(1, 1), s_zz, s(0, 1), 0, 0});
  else
    out.set_deviator(id, {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2)});
}

template class Common<2>;
template class Common<3>;

}  // namespace taut
