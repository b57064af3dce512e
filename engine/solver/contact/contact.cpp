// Compiled once per instruction set; see engine/CMakeLists.txt.
#include "engine/solver/contact/contact.hpp"

namespace taut::inline TAUT_ISA {

template <int Dim>
Contact<Dim>::Contact(const SolverInput& input)
    : by_faces_(input.contact == ContactLaw::surface),
      between_bodies_(input.contact != ContactLaw::sph && input.initial.first.size() > 2),
      active_(between_bodies_ || input.meets_itself || !input.scene.walls.empty()),
      stiffer_(std::max(1.0, input.constants.contact_stiffness / 2)),
      walls_(input.scene),
      pairs_(input),
      faces_(input) {
  for (const Probe& probe : input.scene.probes)
    if (probe.kind == Probe::Kind::contact_force)
      asked_.push_back({probe.bodies[0], probe.wall < 0 ? probe.bodies[1] : -1, probe.wall, {}});
}

template <int Dim>
bool Contact<Dim>::prepare(const Particles<Dim>& s, double way) {
  if (!active_) return false;
  for (Asked& asked : asked_) asked.impulse = V{};
  const bool again = by_faces_ ? faces_.prepare(s, walls_, way) : pairs_.prepare(s, walls_, way);
  if (again) force_.assign(s.size(), V{});
  return again;
}

template <int Dim>
void Contact<Dim>::search(const Particles<Dim>& s) {
  if (!active_) return;
  by_faces_ ? faces_.search(s, walls_) : pairs_.search(s, walls_);
  force_.assign(s.size(), V{});
}

template <int Dim>
void Contact<Dim>::evaluate(const Particles<Dim>& s, double dt, int threads) {
  if (!active_) return;
  by_faces_ ? faces_.evaluate(s, dt, walls_, force_, threads) : pairs_.evaluate(s, dt, walls_, force_);
  for (Asked& asked : asked_) asked.impulse += dt * force_now(s, asked);
}

template <int Dim>
auto Contact<Dim>::force_now(const Particles<Dim>& s, const Asked& asked) const -> V {
  if (asked.wall >= 0)
    return by_faces_ ? faces_.of_wall(asked.body, asked.wall, walls_)
                     : pairs_.of_wall(s, asked.body, asked.wall, walls_);
  if (!between_bodies_) return {};
  return by_faces_ ? faces_.between(asked.body, asked.other) : pairs_.between(s, asked.body, asked.other);
}

template <int Dim>
auto Contact<Dim>::impulse(int body, int other, int wall) const -> V {
  for (const Asked& asked : asked_)
    if (asked.body == body && asked.wall == wall && (wall >= 0 || asked.other == other)) return asked.impulse;
  return {};
}

template <int Dim>
double Contact<Dim>::energy(const Particles<Dim>& s) {
  if (!active_) return 0;
  return by_faces_ ? faces_.energy(s, walls_) : pairs_.energy(s, walls_);
}

template <int Dim>
Neighbors Contact<Dim>::neighbors(int particles) const {
  return pairs_.neighbors(particles);
}

template class Contact<2>;
template class Contact<3>;

}  // namespace taut::inline TAUT_ISA
