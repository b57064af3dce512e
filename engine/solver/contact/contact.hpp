#pragma once

#include <type_traits>
#include <vector>

#include "engine/solver/contact/face_contacts.hpp"
#include "engine/solver/contact/facet_contacts.hpp"
#include "engine/solver/contact/pair_contacts.hpp"
#include "engine/solver/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut::inline TAUT_ISA {

template <int Dim>
using ContactsOfFaces = std::conditional_t<Dim == 3, FacetContacts, FaceContacts<Dim>>;

/// What bodies do to each other, parts of one body that fold upon each other, and walls to them, by the law
/// `surface` on faces (face_contacts.hpp, in 3D facet_contacts.hpp) and by the others on pairs of particles
/// (pair_contacts.hpp). With the law `sph`, which is the solver's own business, pairs act at walls only. What
/// no other body, no wall and no fold can reach is not `active` and costs nothing.
///
/// Once a step: `prepare`; the positions go to where forces are wanted; `evaluate`; where it is `acting`,
/// each particle takes its `force` for its new velocity; `stop_approach` changes the new velocities of those
/// that meet (impulse). A solver that stores its particles in another order calls `search` after that.
template <int Dim>
class Contact {
 public:
  using V = Vec<double, Dim>;

  /// How far probes see a gap before it closes, spacings.
  static constexpr double reach = PairContacts<Dim>::reach;

  explicit Contact(const SolverInput& input);

  /// Particles of two bodies act on each other here, not as those of one.
  bool between_bodies() const { return between_bodies_; }
  /// There are particles that may have a force.
  bool acting() const { return !touching().empty(); }

  /// Searches anew what the fastest particle, whose next way is `way`, m, may have come out of. True if it
  /// did.
  bool prepare(const Particles<Dim>& s, double way);
  void search(const Particles<Dim>& s);

  /// The forces at the positions that `s` has now, which act for `dt`, s.
  void evaluate(const Particles<Dim>& s, double dt, int threads);

  /// How much stiffer than the material at rest it is anywhere, as last evaluated.
  double stiffening() const { return by_faces_ && acting() ? stiffer_ * faces_.stiffening() : 1; }

  /// On particle i, N (per metre depth in 2D), as last evaluated.
  const V& force(int i) const { return force_[i]; }

  /// Impulse law: `change(i, impulse)`, N s (per metre depth in 2D), for each touching particle, with the
  /// positions and velocities that `s` had before the first of them. The positions have followed the new
  /// velocities for `gone`, s, from where the forces of the step acted; there the impulses act too, so that
  /// they keep the angular momentum. `inverse_mass(i)`, 1/kg, is 0 for one that cannot be moved.
  template <class InverseMass, class Change>
  void stop_approach(const Particles<Dim>& s, double gone, const InverseMass& inverse_mass,
                     const Change& change) {
    if (!active_ || !pairs_.impulses()) return;
    pairs_.stop_approach(s, gone, walls_, inverse_mass, change);
    for (Asked& asked : asked_)
      if (asked.wall >= 0 || between_bodies_)
        asked.impulse += pairs_.given(asked.body, asked.other, asked.wall);
  }

  /// What a body got from another one, or from a wall where that is not below 0, in the last step, N s (per
  /// metre depth in 2D), if a probe asks for it.
  V impulse(int body, int other, int wall) const;

  /// What walls have given to the bodies so far.
  const Impulse& of_walls() const { return walls_.given(); }

  /// Of all contacts at the positions that `s` has now, J (per metre depth in 2D). Impulses have none.
  double energy(const Particles<Dim>& s);

  /// Pairs of two bodies in the form in which probes look for neighbours.
  Neighbors neighbors(int particles) const;
  /// Those who measure a gap from faces; null where they do from particles.
  ContactsOfFaces<Dim>* faces() { return by_faces_ ? &faces_ : nullptr; }

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    walls_.serialize(archive, particles);
    pairs_.serialize(archive, particles);
    faces_.serialize(archive, particles, walls_.count());
    archive.fixed(force_);
    archive.check("a contact", [&] { return active_ || !acting(); });
  }

 private:
  struct Asked {
    int body, other, wall;
    V impulse;  // N s
  };
  V force_now(const Particles<Dim>& s, const Asked& asked) const;
  const std::vector<int>& touching() const { return by_faces_ ? faces_.touching() : pairs_.touching(); }

  bool by_faces_, between_bodies_, active_;
  double stiffer_;  // springs between faces than the material, 1 at least
  WallContacts<Dim> walls_;
  PairContacts<Dim> pairs_;
  ContactsOfFaces<Dim> faces_;
  std::vector<V> force_;      // N
  std::vector<Asked> asked_;  // by probes
};

/// Of a law of contact between bodies that is not `sph`.
constexpr const TermInfo& contact_info(ContactLaw law) {
  return law == ContactLaw::impulse         ? impulse_info
         : law == ContactLaw::lennard_jones ? lennard_jones_info
         : law == ContactLaw::surface       ? surface_contact_info
                                            : penalty_info;
}

}  // namespace taut::inline TAUT_ISA
