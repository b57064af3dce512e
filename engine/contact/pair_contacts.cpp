#include "engine/contact/pair_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "engine/terms/penalty_contact.hpp"

namespace taut {

template <int Dim>
PairContacts<Dim>::PairContacts(const SolverInput& input, const ContactLawRow& law, bool between_bodies)
    : law_(law),
      dp_(input.constants.dp),
      stiffness_(input.constants.contact_stiffness),
      candidates_(input, between_bodies, ContactMechanism<Dim>::reach * dp_) {
  const auto by_contact = [](const Probe& probe) { return probe.kind == Probe::Kind::contact_force; };
  const std::size_t bodies = input.scene.bodies.size();
  if (has_impulses() && std::ranges::any_of(input.scene.probes, by_contact))
    recorded_impulses_.assign(bodies, std::vector<V>(bodies + input.scene.walls.size()));
  for (const int material : input.initial.material) K_.push_back(input.materials[material].K);
}

template <int Dim>
bool PairContacts<Dim>::search(const Particles<Dim>& s, const WallContacts<Dim>& walls,
                               std::optional<double> way) {
  const bool searched = candidates_.search(s, walls, way);
  if (searched) touching_ = candidates_.particles(s.size());
  return searched;
}

template <int Dim>
double PairContacts<Dim>::modulus(const Particles<Dim>& s, int i, int j) const {
  return contact_modulus(K_[s.id[i]], K_[s.id[j]], stiffness_);
}

/// Calls f(j, x_ij, r) for each particle j that touched particle i `gone` seconds ago, with x_ij and r of that time.
template <int Dim>
template <class F>
void PairContacts<Dim>::for_each_touch(const Particles<Dim>& s, int i, double gone, const F& f) const {
  candidates_.for_each(i, [&](int j) {
    const V d = (s.x[i] - s.x[j]) - gone * (s.v[i] - s.v[j]);
    const double r = std::sqrt(dot(d, d));
    if (r > 0 && r < dp_) f(j, d, r);
  });
}

/// Calls f(i, wall, x, r) for each particle i that touched its mirror image in a wall `gone` seconds ago. `x`: position
/// at that time, m; `r`: distance of the image, m, negative inside the wall.
template <int Dim>
template <class F>
void PairContacts<Dim>::for_each_wall_touch(const Particles<Dim>& s, const WallContacts<Dim>& walls,
                                            double gone, const F& f) const {
  for (const auto& [i, wall] : candidates_.near_walls()) {
    const V x = s.x[i] - gone * s.v[i];
    const double r = 2 * walls.height(wall, x);
    if (r < dp_) f(i, wall, x, r);
  }
}

template <int Dim>
void PairContacts<Dim>::evaluate(const Particles<Dim>& s, double dt, WallContacts<Dim>& walls,
                                 std::vector<V>& force, int) {
  const auto push = law_.force;
  if (!push) return;
  for (const int i : touching_) {
    force[i] = V{};
    for_each_touch(s, i, 0, [&](int j, const V& d, double r) {
      force[i] += (push(r, dp_, modulus(s, i, j), Dim) / r) * d;
    });
  }
  for_each_wall_touch(s, walls, 0, [&](int i, int wall, const V& x, double r) {
    const V f = push(r, dp_, modulus(s, i, i), Dim) * walls.normal(wall);
    force[i] += f;
    walls.record_impulse(x, (dt * s.mobile[i]) * f);
  });
}

template <int Dim>
double PairContacts<Dim>::energy(const Particles<Dim>& s, const WallContacts<Dim>& walls) {
  const auto stored = law_.energy;
  double twice = 0;
  if (!stored) return twice;
  for (const int i : touching_)
    for_each_touch(s, i, 0,
                   [&](int j, const V&, double r) { twice += stored(r, dp_, modulus(s, i, j), Dim); });
  for_each_wall_touch(s, walls, 0, [&](int i, int, const V&, double r) {
    twice += s.mobile[i] * stored(r, dp_, modulus(s, i, i), Dim);
  });
  return 0.5 * twice;
}

template <int Dim>
auto PairContacts<Dim>::between(const Particles<Dim>& s, int a, int b) const -> V {
  V sum{};
  if (!law_.force) return sum;
  for (const int i : touching_) {
    if (s.body[i] != a) continue;
    for_each_touch(s, i, 0, [&](int j, const V& d, double r) {
      if (s.body[j] == b) sum += (law_.force(r, dp_, modulus(s, i, j), Dim) / r) * d;
    });
  }
  return sum;
}

template <int Dim>
auto PairContacts<Dim>::of_wall(const Particles<Dim>& s, int a, int wall,
                                const WallContacts<Dim>& walls) const -> V {
  double sum = 0;
  if (!law_.force) return {};
  for_each_wall_touch(s, walls, 0, [&](int i, int touched, const V&, double r) {
    if (touched == wall && s.body[i] == a) sum += law_.force(r, dp_, modulus(s, i, i), Dim);
  });
  return sum * walls.normal(wall);
}

namespace {

/// Inverse mass along the unit vector e; `inverse` is 0 along fixed axes and equal along the others.
template <int Dim>
double along(const Vec<double, Dim>& inverse, const Vec<double, Dim>& e) {
  constexpr double round_off = 1e-12;
  double most = 0, free = 1;
  for (int k = 0; k < Dim; ++k) {
    most = std::max(most, inverse[k]);
    if (inverse[k] == 0) free -= e[k] * e[k];
  }
  return free > round_off ? free * most : 0;
}

}  // namespace

template <int Dim>
void PairContacts<Dim>::stop_approach(const Particles<Dim>& s, double gone, WallContacts<Dim>& walls,
                                      const std::vector<V>& inverse_mass, std::vector<V>& impulse) {
  const auto stop = law_.impulse;
  for (std::vector<V>& given : recorded_impulses_) std::ranges::fill(given, V{});
  for (const int i : touching_) {
    impulse[i] = V{};
    for_each_touch(s, i, gone, [&](int j, const V& d, double r) {
      const double closing_speed = -dot(s.v[i] - s.v[j], d) / r;
      const V e = (1 / r) * d;
      const V given = (stop(closing_speed, along(inverse_mass[i], e), along(inverse_mass[j], e)) / r) * d;
      impulse[i] += given;
      record_impulse(s.body[i], s.body[j], given);
    });
  }
  for_each_wall_touch(s, walls, gone, [&](int i, int wall, const V& x, double) {
    const V& normal = walls.normal(wall);
    const V given = stop(-dot(s.v[i], normal), along(inverse_mass[i], normal), 0) * normal;
    impulse[i] += given;
    record_impulse(s.body[i], bodies() + wall, given);
    walls.record_impulse(x, given);
  });
}

template <int Dim>
auto PairContacts<Dim>::impulse(int body, int other, int wall) const -> V {
  return recorded_impulses_[body][wall < 0 ? other : bodies() + wall];
}

template class PairContacts<2>;
template class PairContacts<3>;

}  // namespace taut
