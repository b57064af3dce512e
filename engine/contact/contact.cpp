#include "engine/contact/contact.hpp"

#include "engine/contact/face_contacts.hpp"
#include "engine/contact/facet_contacts.hpp"
#include "engine/contact/pair_contacts.hpp"
#include "engine/terms/contact_laws.hpp"

namespace taut {

template <int Dim>
Contact<Dim>::Contact(const SolverInput& input) : walls_(input.scene) {
  const ContactLawRow& law = contact_row(input.contact);
  between_bodies_ = law.between != ContactBetween::all_neighbors && input.initial.first.size() > 2;
  if (!between_bodies_ && !input.keeps_neighbors && input.scene.walls.empty()) {
    mechanism_ = std::make_unique<ContactMechanism<Dim>>();
  } else if (law.between == ContactBetween::faces) {
    auto faces = std::make_unique<ContactsOfFaces<Dim>>(input);
    faces_ = faces.get();
    mechanism_ = std::move(faces);
  } else {
    mechanism_ = std::make_unique<PairContacts<Dim>>(input, law, between_bodies_);
  }
  for (const Probe& probe : input.scene.probes)
    if (probe.kind == Probe::Kind::contact_force)
      probed_.push_back({probe.bodies[0], probe.wall < 0 ? probe.bodies[1] : -1, probe.wall, {}});
}

template <int Dim>
bool Contact<Dim>::prepare(const Particles<Dim>& s, double way) {
  for (Probed& probed : probed_) probed.impulse = V{};
  const bool searched = mechanism_->search(s, walls_, way);
  if (searched) reset_forces(s.size());
  return searched;
}

template <int Dim>
void Contact<Dim>::search(const Particles<Dim>& s) {
  mechanism_->search(s, walls_, {});
  reset_forces(s.size());
}

template <int Dim>
void Contact<Dim>::evaluate(const Particles<Dim>& s, double dt, int threads) {
  mechanism_->evaluate(s, dt, walls_, force_, threads);
  for (auto& [body, other, wall, impulse] : probed_)
    impulse +=
        dt * (wall < 0 ? mechanism_->between(s, body, other) : mechanism_->of_wall(s, body, wall, walls_));
}

template <int Dim>
void Contact<Dim>::find_impulses(const Particles<Dim>& s, double gone) {
  impulse_.resize(s.size());
  mechanism_->stop_approach(s, gone, walls_, inverse_mass_, impulse_);
  for (Probed& probed : probed_)
    probed.impulse += mechanism_->impulse(probed.body, probed.other, probed.wall);
}

template <int Dim>
auto Contact<Dim>::impulse(int body, int other, int wall) const -> V {
  for (const Probed& probed : probed_)
    if (probed.body == body && probed.wall == wall && (wall >= 0 || probed.other == other))
      return probed.impulse;
  return {};
}

template class Contact<2>;
template class Contact<3>;

}  // namespace taut
