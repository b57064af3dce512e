#pragma once

#include <memory>
#include <vector>

#include "engine/contact/contact_mechanism.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// Contact of bodies with each other, with walls and of folds of one body, by one mechanism: the forces, the
/// impulses of walls and the values of probes.
///
/// Order of calls in a step: `prepare`; positions move to where forces are evaluated; `evaluate`; if contact is
/// `acting`, each particle takes its `force` for its new velocity; `stop_approach` changes the new velocities of
/// particles that meet (impulse law). A solver that stores its particles in another order calls `search` after that.
template <int Dim>
class Contact {
 public:
  using V = Vec<double, Dim>;

  /// Range of the pairs that probes of a gap see, in spacings.
  static constexpr double reach = ContactMechanism<Dim>::reach;

  explicit Contact(const SolverInput& input);

  /// Particles of two bodies act on each other here, and not as particles of one body.
  bool between_bodies() const { return between_bodies_; }
  /// Some particles may have a force.
  bool acting() const { return !mechanism_->touching().empty(); }

  /// Repeats the search if the fastest particle, moving `way`, m, next, may leave the range of the last search.
  /// Returns whether it searched.
  bool prepare(const Particles<Dim>& s, double way);
  void search(const Particles<Dim>& s);

  /// Evaluates the forces, which act for `dt`, s, at the current positions.
  void evaluate(const Particles<Dim>& s, double dt, int threads);

  /// Largest ratio of the stiffness of a contact to the stiffness of the material, 1 at least, as last evaluated.
  double stiffening() const { return mechanism_->stiffening(); }

  /// Force on particle i, N (per metre depth in 2D), as last evaluated; only if contact is `acting`.
  const V& force(int i) const { return force_[i]; }

  /// Impulse law: calls `change(i, impulse)`, N s (per metre depth in 2D), for each touching particle; all impulses
  /// are those of the positions and velocities before the first call. The positions have followed the new
  /// velocities for `gone`, s. The impulses act where the forces of the step acted, so that they conserve angular
  /// momentum. `inverse_mass(i)`, 1/kg, is 0 for a particle that cannot be moved.
  template <class InverseMass, class Change>
  void stop_approach(const Particles<Dim>& s, double gone, const InverseMass& inverse_mass,
                     const Change& change) {
    if (!mechanism_->has_impulses()) return;
    inverse_mass_.resize(s.size());
    for (const int i : mechanism_->touching()) inverse_mass_[i] = inverse_mass(i);
    find_impulses(s, gone);
    for (const int i : mechanism_->touching()) change(i, impulse_[i]);
  }

  /// Impulse on a body of another body, or of a wall if `wall` is not negative, in the last step, N s (per metre
  /// depth in 2D); only if a probe measures it.
  V impulse(int body, int other, int wall) const;

  /// Impulses of all walls on the bodies so far.
  const Impulse& of_walls() const { return walls_.given(); }

  /// Energy of all contacts at the current positions, J (per metre depth in 2D); 0 for impulses.
  double energy(const Particles<Dim>& s) const { return mechanism_->energy(s, walls_); }

  /// Pairs of two bodies in the form in which probes look for neighbours.
  Neighbors neighbors(int particles) const { return mechanism_->neighbors(particles); }
  /// The faces from which a gap is measured; null if it is measured from particles.
  ContactsOfFaces<Dim>* faces() { return faces_; }

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    archive(walls_);
    mechanism_->serialize(archive, particles, walls_);
    archive(force_);
    archive.check("a contact", [&] { return force_.size() == (acting() ? particles : std::size_t{0}); });
  }

 private:
  struct Probed {  // by a probe
    int body, other, wall;
    V impulse;  // in the last step, N s
  };
  void reset_forces(int particles) { force_.assign(acting() ? particles : 0, V{}); }
  void find_impulses(const Particles<Dim>& s, double gone);

  bool between_bodies_ = false;
  WallContacts<Dim> walls_;
  std::unique_ptr<ContactMechanism<Dim>> mechanism_;
  ContactsOfFaces<Dim>* faces_ = nullptr;  // the mechanism, if it acts between faces
  std::vector<V> force_;                   // N
  std::vector<double> inverse_mass_;       // 1/kg
  std::vector<V> impulse_;                 // N s
  std::vector<Probed> probed_;
};

}  // namespace taut
