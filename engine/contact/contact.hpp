#pragma once

#include <memory>
#include <vector>

#include "engine/contact/contact_mechanism.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// Contact between bodies, folds of one body and walls, by one mechanism.
/// In each step: `prepare`; move positions to where forces are evaluated; `evaluate`; if `acting`, add `force` to
/// each particle; `stop_approach` (impulse law). After a change of the storage order, call `search`.
template <int Dim>
class Contact {
 public:
  using V = Vec<double, Dim>;

  /// Range of pairs for gap probes, in spacings.
  static constexpr double reach = ContactMechanism<Dim>::reach;

  explicit Contact(const SolverInput& input);

  /// Particles of two bodies interact here, not as particles of one body.
  bool between_bodies() const { return between_bodies_; }
  /// Some particles may have a force.
  bool acting() const { return !mechanism_->touching().empty(); }

  /// Searches if the fastest particle, about to move `way`, m, may leave the range of the last search. Returns
  /// whether it did.
  bool prepare(const Particles<Dim>& s, double way);
  void search(const Particles<Dim>& s);

  /// Evaluates the forces at the current positions; they act for `dt`, s.
  void evaluate(const Particles<Dim>& s, double dt, int threads);

  /// Largest ratio of contact stiffness to material stiffness, at least 1, as last evaluated.
  double stiffening() const { return mechanism_->stiffening(); }

  /// Force on particle i, N (per metre depth in 2D), as last evaluated. Requires `acting`.
  const V& force(int i) const { return force_[i]; }

  /// Impulse law: calls `change(i, impulse)`, N s (per metre depth in 2D), for each touching particle. All impulses
  /// follow from the state before the first call. Positions have already moved with the new velocities for `gone`, s;
  /// impulses act where the forces acted, which conserves angular momentum. `inverse_mass(i)`, 1/kg, is 0 for an
  /// immovable particle.
  template <class InverseMass, class Change>
  void stop_approach(const Particles<Dim>& s, double gone, const InverseMass& inverse_mass,
                     const Change& change) {
    if (!mechanism_->has_impulses()) return;
    inverse_mass_.resize(s.size());
    for (const int i : mechanism_->touching()) inverse_mass_[i] = inverse_mass(i);
    find_impulses(s, gone);
    for (const int i : mechanism_->touching()) change(i, impulse_[i]);
  }

  /// Impulse on a body by another body, or by a wall if `wall` ≥ 0, in the last step, N s (per metre depth in 2D).
  /// Computed only for probes.
  V impulse(int body, int other, int wall) const;

  /// Total impulses of walls on bodies so far.
  const Impulse& of_walls() const { return walls_.given(); }

  /// Contact energy at the current positions, J (per metre depth in 2D); 0 for impulses.
  double energy(const Particles<Dim>& s) const { return mechanism_->energy(s, walls_); }

  /// Pairs of two bodies as neighbour lists, for probes.
  Neighbors neighbors(int particles) const { return mechanism_->neighbors(particles); }
  /// Faces for gaps; null if gaps are measured between particles.
  ContactsOfFaces<Dim>* faces() { return faces_; }

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    archive(walls_);
    mechanism_->serialize(archive, particles, walls_);
    archive(force_);
    archive.check("a contact", [&] { return force_.size() == (acting() ? particles : std::size_t{0}); });
  }

 private:
  struct Probed {
    int body, other, wall;
    V impulse;  // in the last step, N s
  };
  void reset_forces(int particles) { force_.assign(acting() ? particles : 0, V{}); }
  void find_impulses(const Particles<Dim>& s, double gone);

  bool between_bodies_ = false;
  WallContacts<Dim> walls_;
  std::unique_ptr<ContactMechanism<Dim>> mechanism_;
  ContactsOfFaces<Dim>* faces_ = nullptr;  // the mechanism if it acts between faces, else null
  std::vector<V> force_;                   // N
  std::vector<double> inverse_mass_;       // 1/kg
  std::vector<V> impulse_;                 // N s
  std::vector<Probed> probed_;
};

}  // namespace taut
