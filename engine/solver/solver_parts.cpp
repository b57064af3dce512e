// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/solver/solver_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/core/median.hpp"
#include "engine/error.hpp"

namespace taut::inline TAUT_ISA {

template <int Dim>
SolverParts<Dim>::SolverParts(const SolverInput& input, double support)
    : c_(input.constants),
      initial_(input.initial),
      contact_(input),
      drives_(input.scene, input.initial),
      guides_(input.initial),
      loads_(input.scene, input.initial),
      reactions_(input.scene),
      recorder_(input.scene, input.initial, support),
      team_(input.threads) {
  threads_ = input.threads;
  support_ = support;
  keeps_neighbors_ = taut::keeps_neighbors(input.method);
  const auto point = [](const Point& p) {
    V v;
    for (int k = 0; k < Dim; ++k) v[k] = p[k];
    return v;
  };
  for (int i = 0; i < initial_.size(); ++i) {
    s_.x.push_back(point(initial_.x[i]));
    s_.v.push_back(drives_.moves(i) ? drives_.velocity(i) : point(initial_.v[i]));
    s_.m.push_back(input.materials[initial_.material[i]].rho0 * initial_.V0[i]);
    s_.mobile.push_back(initial_.held[i] ? 0 : 1);
    vmax_ = std::max(vmax_, std::sqrt(dot(s_.v[i], s_.v[i])));
  }
  s_.id.resize(s_.size());
  std::iota(s_.id.begin(), s_.id.end(), 0);
  s_.body = initial_.body;
  s_.material = initial_.material;
  s_.sph_contact = input.contact == ContactLaw::sph && initial_.first.size() > 2;
}

/// Weight is carried by what holds a particle, loads are not.
template <int Dim>
auto SolverParts<Dim>::reaction(int i) -> V {
  const int id = s_.id[i];
  const bool free = s_.mobile[i] != 0 && !drives_.moves(id);
  const V all = reactions_.missing(s_, i) - s_.m[i] * loads_.pull(s_, i, free);
  return free ? guides_.along(id, all) : all;
}

namespace {

/// Of each body that of its middle particle, in each component for itself: what a few have gone wrong with does not
/// change it.
template <int Dim>
std::vector<Vec<double, Dim>> middle_velocities(const State<Dim>& s, int bodies) {
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

/// Names the first particle in the order of creation that went wrong.
template <int Dim>
void SolverParts<Dim>::refuse_speeds() const {
  const double limit = greatest_mach_number * c_.c0, of_bodies = greatest_mach_number_of_bodies * c_.c0;
  const std::vector<V> middle = middle_velocities(s_, static_cast<int>(initial_.first.size()) - 1);
  int culprit = s_.size();  // id
  bool of_body = false;
  for (int i = 0; i < s_.size(); ++i) {
    const V against = s_.v[i] - middle[s_.body[i]];
    const bool leaves = !(dot(against, against) <= limit * limit);
    if ((!leaves && dot(s_.v[i], s_.v[i]) <= of_bodies * of_bodies) || s_.id[i] > culprit) continue;
    culprit = s_.id[i], of_body = !leaves;
  }
  if (culprit == s_.size()) return;
  const std::string what =
      of_body ? fmt::format("particle {} and its body are faster than {:g} m/s ({:g} c0)", culprit, of_bodies,
                            greatest_mach_number_of_bodies)
              : fmt::format(
                    "particle {} is faster than its body by more than {:g} m/s ({:g} c0), or its speed is "
                    "not a number",
                    culprit, limit, greatest_mach_number);
  throw NumericalError(step_, time_, culprit, "velocity", what);
}

template <int Dim>
double SolverParts<Dim>::fastest() const {
  double fastest2 = 0;
  for (const V& v : s_.v) fastest2 = std::max(fastest2, dot(v, v));
  return std::sqrt(fastest2);
}

/// Of a state that was loaded: every particle is there once, with its body and material.
template <int Dim>
bool SolverParts<Dim>::are_of_this_scene() const {
  std::vector<bool> seen(s_.size());
  for (int i = 0; i < s_.size(); ++i) {
    const int id = s_.id[i];
    if (!is_below(id, s_.size()) || seen[id]) return false;
    seen[id] = true;
    if (s_.body[i] != initial_.body[id] || s_.material[i] != initial_.material[id]) return false;
  }
  return true;
}

/// The places and velocities of a state that was loaded.
template <int Dim>
bool SolverParts<Dim>::are_numbers() const {
  for (int i = 0; i < s_.size(); ++i)
    for (int k = 0; k < Dim; ++k)
      if (!std::isfinite(s_.x[i][k]) || !std::isfinite(s_.v[i][k])) return false;
  return true;
}

template <int Dim>
void SolverParts<Dim>::begin_snapshot() {
  const std::size_t n = s_.size();
  Snapshot& out = snapshot_;
  out.time = time_;
  out.step = step_;
  out.contact_energy = contact_.energy(s_);
  out.work = drives_.work() + loads_.work();
  out.damped = loads_.damped();
  out.of_walls = contact_.of_walls();
  if (!out.m.empty()) return;
  out.resize(Dim, n);
  out.body = initial_.body;
  out.material = initial_.material;
  out.driven = initial_.driven();
  for (std::size_t i = 0; i < n; ++i) {
    out.held[s_.id[i]] = s_.mobile[i] == 0;
    for (int k = 0; k < Dim; ++k) out.x0[i * Dim + k] = initial_.x[i][k];
    out.diameter[i] = std::pow(initial_.V0[i], 1.0 / Dim);
  }
}

template <int Dim>
void SolverParts<Dim>::store(int i, double rho, double p, const Sym<double, Dim>& s, double s_zz) {
  Snapshot& out = snapshot_;
  const std::size_t id = s_.id[i];
  for (int k = 0; k < Dim; ++k) {
    out.x[id * Dim + k] = s_.x[i][k];
    out.v[id * Dim + k] = s_.v[i][k];
  }
  out.m[id] = s_.m[i];
  out.rho[id] = rho;
  out.p[id] = p;
  if constexpr (Dim == 2)
    out.set_deviator(id, {s(0, 0), s(1, 1), s_zz, s(0, 1), 0, 0});
  else
    out.set_deviator(id, {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2)});
}

template class SolverParts<2>;
template class SolverParts<3>;

}  // namespace taut::inline TAUT_ISA
