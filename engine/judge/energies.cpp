#include "engine/judge/energies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/deviator.hpp"
#include "engine/diagnostics/kernels.hpp"

namespace taut {
namespace {

constexpr double small_part = 0.1;         // of the received energy
constexpr std::size_t most_of_pairs = 64;  // bodies; if there are more, all form one group

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point sum(const Point& a, double factor, const Point& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

bool is_acted_on(const Scene& scene, const Body& body) {
  const auto exists = [](const Expression& expression) { return bool(expression); };
  return scene.damping > 0 || exists(body.clamped) || std::ranges::any_of(body.guided, exists) ||
         !body.drives.empty() || !body.loads.empty();
}

}  // namespace

EnergyTest::EnergyTest(const Scene& scene, const Snapshot& start, double support, bool keeps_neighbors)
    : scene_(&scene),
      reach_(std::max(support, 2 * scene.spacing)),
      keeps_neighbors_(keeps_neighbors),
      start_contact_(start.contact_energy),
      last_time_(start.time) {
  const double mass = std::accumulate(start.m.begin(), start.m.end(), 0.0);
  rounding_ = energy_of_rounding(scene, start) / mass;
  const std::size_t bodies = scene.bodies.size();
  for (std::size_t b = 0; b <= bodies; ++b)
    first_.push_back(static_cast<std::size_t>(std::ranges::lower_bound(start.body, static_cast<int>(b)) -
                                              start.body.begin()));
  for (const Body& body : scene.bodies) is_acted_on_.push_back(is_acted_on(scene, body));
  start_ = last_ = sums(start);
  group_.resize(bodies);
  std::iota(group_.begin(), group_.end(), 0);
  if (bodies > most_of_pairs) std::ranges::fill(group_, 0);
  at_wall_.assign(bodies, 0), fell_.assign(bodies, 0);
  most_work_.assign(bodies, 0), spin_scale_.assign(bodies, 0);
  merge(start_, start.time);
}

template <int Dim>
void EnergyTest::add_up(const Snapshot& now, std::vector<Sums>& all) const {
  std::vector<StrainDivisors> divisors;
  for (const Material& material : scene_->materials)
    divisors.push_back({2 * material.bulk_modulus(), 4 * material.shear_modulus()});
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < all.size(); ++b) {
    Sums& to = all[b];
    if (first_[b] == first_[b + 1]) continue;
    Point moment{}, low, high;
    low.fill(infinity), high.fill(-infinity);
    double second_moment = 0, fastest2 = 0;
    const double* const v0 = &now.v[Dim * first_[b]];
    for (std::size_t i = first_[b]; i < first_[b + 1]; ++i) {
      const double *x = &now.x[Dim * i], *v = &now.v[Dim * i], m = now.m[i];
      double x2 = 0, v2 = 0, relative2 = 0;
      for (int k = 0; k < Dim; ++k) {
        x2 += x[k] * x[k], v2 += v[k] * v[k], relative2 += (v[k] - v0[k]) * (v[k] - v0[k]);
        moment[k] += m * x[k], to.momentum[k] += m * v[k];
        low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
      }
      if constexpr (Dim == 3) {
        to.spin[0] += m * (x[1] * v[2] - x[2] * v[1]);
        to.spin[1] += m * (x[2] * v[0] - x[0] * v[2]);
      }
      to.spin[2] += m * (x[0] * v[1] - x[1] * v[0]);
      to.mass += m, to.kinetic += 0.5 * m * v2, second_moment += m * x2;
      fastest2 = std::max(fastest2, relative2);
      if (now.strain_energy.empty()) {
        const auto [twice_K, four_G] = divisors[static_cast<std::size_t>(now.material[i])];
        to.strain += m / now.rho[i] * (now.p[i] * now.p[i] / twice_K + deviator_squared(now, i) / four_G);
      } else {
        to.strain += now.strain_energy[i];
      }
    }
    for (int k = 0; k < Dim; ++k) to.low[k] = low[k], to.high[k] = high[k];
    to.centre = sum({}, 1 / to.mass, moment);
    to.inertia = std::max(second_moment - dot(moment, to.centre), 0.0);
    to.fastest = std::sqrt(fastest2);
  }
}

auto EnergyTest::sums(const Snapshot& now) const -> std::vector<Sums> {
  std::vector<Sums> all(scene_->bodies.size());
  now.dim == 3 ? add_up<3>(now, all) : add_up<2>(now, all);
  return all;
}

double EnergyTest::work(const Snapshot& now, std::size_t body) const {
  if (now.body_work.empty()) return start_.size() == 1 ? now.work : 0;
  return now.body_work[body];
}

/// Whether the boxes that a and b swept since the last observation, relative to the centre of a, come within `reach_`.
bool EnergyTest::may_meet(std::size_t a, std::size_t b, const std::vector<Sums>& now, double time) const {
  const double beyond =
      reach_ + 0.5 * (time - last_time_) *
                   (std::max(now[a].fastest, last_[a].fastest) + std::max(now[b].fastest, last_[b].fastest));
  for (std::size_t k = 0; k < static_cast<std::size_t>(scene_->dim); ++k) {
    const auto range = [&](std::size_t body) {
      return std::pair(
          std::min(now[body].low[k] - now[a].centre[k], last_[body].low[k] - last_[a].centre[k]),
          std::max(now[body].high[k] - now[a].centre[k], last_[body].high[k] - last_[a].centre[k]));
    };
    const auto [low_a, high_a] = range(a);
    const auto [low_b, high_b] = range(b);
    if (low_b > high_a + beyond || low_a > high_b + beyond) return false;
  }
  return true;
}

bool EnergyTest::may_touch_wall(std::size_t b, const std::vector<Sums>& now, double time) const {
  const double beyond = reach_ + 0.5 * (time - last_time_) * std::max(now[b].fastest, last_[b].fastest);
  return std::ranges::any_of(scene_->walls, [&](const Wall& wall) {
    const auto height = [&](const Sums& of) {
      double least = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(scene_->dim); ++k)
        least += wall.normal[k] * ((wall.normal[k] > 0 ? of.low[k] : of.high[k]) - wall.at[k]);
      return least;
    };
    return std::min(height(now[b]), height(last_[b])) < beyond;
  });
}

void EnergyTest::merge(const std::vector<Sums>& now, double time) {
  const std::size_t bodies = group_.size();
  for (std::size_t b = 0; b < bodies; ++b)
    if (!at_wall_[b] && may_touch_wall(b, now, time)) at_wall_[b] = 1;
  if (bodies > most_of_pairs) return;
  for (std::size_t a = 0; a < bodies; ++a)
    for (std::size_t b = a + 1; b < bodies; ++b) {
      if (group_[a] == group_[b] || !may_meet(a, b, now, time)) continue;
      const auto [lower, higher] = std::minmax({group_[a], group_[b]});
      std::ranges::replace(group_, higher, lower);
    }
}

auto EnergyTest::groups(const std::vector<Sums>& now) const -> std::vector<Group> {
  std::vector<Group> all(group_.size());
  for (std::size_t b = 0; b < group_.size(); ++b) {
    Group& to = all[static_cast<std::size_t>(group_[b])];
    to.meets = to.meets || to.mass > 0 || at_wall_[b];
    to.closed = to.closed && !at_wall_[b] && !is_acted_on_[b];
    to.mass += now[b].mass;
    to.kinetic += now[b].kinetic, to.strain += now[b].strain;
    to.start_kinetic += start_[b].kinetic, to.start_strain += start_[b].strain;
    to.work += most_work_[b];
    to.momentum = sum(to.momentum, 1, now[b].momentum);
    to.start_momentum = sum(to.start_momentum, 1, start_[b].momentum);
  }
  return all;
}

bool EnergyTest::diverges(const Snapshot& now) {
  const std::vector<Sums> bodies = sums(now);
  merge(bodies, now.time);
  for (std::size_t b = 0; b < bodies.size(); ++b) most_work_[b] = std::max(most_work_[b], work(now, b));
  const std::vector<Group> all = groups(bodies);
  const auto meeting = std::ranges::count(all, true, &Group::meets);
  const auto existing = std::ranges::count_if(all, [](const Group& group) { return group.mass > 0; });
  bool any = false;
  for (std::size_t g = 0; g < all.size(); ++g) {
    const Group& group = all[g];
    if (group.mass == 0) continue;
    double kinetic = group.kinetic, start = group.start_kinetic;
    if (group.closed) {
      start -= 0.5 * dot(group.start_momentum, group.start_momentum) / group.mass;
      kinetic += has_gravity(*scene_) ? -0.5 * dot(group.momentum, group.momentum) / group.mass
                                      : dot(sum(sum({}, 0.5, group.start_momentum), -1, group.momentum),
                                            group.start_momentum) /
                                            group.mass;
      kinetic = std::max(kinetic, 0.0), start = std::max(start, 0.0);
    }
    const bool has_contact = existing == 1 || (meeting == 1 && group.meets);
    const double strain = group.strain + (has_contact ? now.contact_energy : 0);
    const double start_strain = group.start_strain + (has_contact || group.meets ? start_contact_ : 0);
    const double given = start + start_strain + (group.closed ? 0 : group.work);
    const double least_strain = std::min(start_strain, 0.0);

    constexpr double margin = 1e4, of_start = 10;
    constexpr double of_common_motion = 1e-12;  // of the initial kinetic energy
    constexpr double of_rest = 0.5e8;  // times the rounding energy: kinetic energy at 1e-4 sound speeds
    const double floor =
        margin * rounding_ * group.mass + of_common_motion * group.start_kinetic - of_start * least_strain;
    const bool received = given > floor;
    const double bound = received ? given : std::max(floor, of_rest * rounding_ * group.mass);

    const bool moves = keeps_neighbors_ || kinetic > small_part * bound;
    const double energy = std::max(moves ? kinetic + strain : 0, kinetic);
    const bool fell = keeps_neighbors_ && strain < least_strain - small_part * bound;
    any = any || energy > 2 * bound || (fell && fell_[g]);
    fell_[g] = fell;
    constexpr double named = 1.1;
    if (const double ratio = energy / bound; received && ratio > named) {
      if (gain_.greatest == 0) gain_.since = now.time;
      gain_.greatest = std::max(gain_.greatest, ratio);
    }
  }
  watch_turn(all, bodies, now.time);
  last_ = bodies, last_time_ = now.time;
  return any;
}

void EnergyTest::watch_turn(const std::vector<Group>& all, const std::vector<Sums>& now, double time) {
  for (std::size_t g = 0; g < all.size(); ++g) {
    const Group& group = all[g];
    if (group.mass == 0 || !group.closed) continue;
    Point spin{}, start_spin{}, moment{}, start_moment{};
    for (std::size_t b = 0; b < now.size(); ++b) {
      if (group_[b] != static_cast<int>(g)) continue;
      spin = sum(spin, 1, now[b].spin), start_spin = sum(start_spin, 1, start_[b].spin);
      moment = sum(moment, now[b].mass, now[b].centre);
      start_moment = sum(start_moment, start_[b].mass, start_[b].centre);
    }
    double inertia = 0;
    for (std::size_t b = 0; b < now.size(); ++b) {
      if (group_[b] != static_cast<int>(g)) continue;
      const Point from = sum(now[b].centre, -1 / group.mass, moment);
      inertia += now[b].inertia + now[b].mass * dot(from, from);
    }
    const double kinetic =
        std::max(group.kinetic - 0.5 * dot(group.momentum, group.momentum) / group.mass, 0.0);
    spin = sum(spin, -1 / group.mass, cross(moment, group.momentum));
    start_spin = sum(start_spin, -1 / group.mass, cross(start_moment, group.start_momentum));
    const Point change = sum(spin, -1, start_spin);
    spin_scale_[g] = std::max(spin_scale_[g], std::sqrt(inertia * 2 * kinetic));
    constexpr double named = 0.01;
    // speeds of 1e-6 sound speeds; a single particle has no inertia
    const double wide = inertia + group.mass * scene_->spacing * scene_->spacing,
                 floor = std::sqrt(wide * group.mass * rounding_ * 1e4);
    if (const double share = std::sqrt(dot(change, change)) / std::max(spin_scale_[g], floor);
        share > named) {
      if (turn_.greatest == 0) turn_.since = time;
      turn_.greatest = std::max(turn_.greatest, share);
    }
  }
}

}  // namespace taut
