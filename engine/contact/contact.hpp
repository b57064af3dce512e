#pragma once

#include <memory>
#include <vector>

#include "engine/contact/contact_mechanism.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// Contact of bodies, folds and walls by one mechanism.
/// In each step: `prepare`; move positions; `evaluate`; add `force` if `acting`; `stop_approach` (impulse law). Call
/// `search` after reordering particles.
template <int Dim>
class Contact {
 public:
  using V = Vec<double, Dim>;

  /// For gap probes, in spacings.
  static constexpr double reach = ContactMechanism<Dim>::reach;

  explicit Contact(const SolverInput& input);

  /// Particles of two bodies interact only by this contact.
  bool between_bodies() const { return between_bodies_; }
  bool acting() const { return !mechanism_->touching().empty(); }

  /// Searches if a particle may leave the last search's range on its next `way`, m. Returns whether it searched.
  bool prepare(const Particles<Dim>& s, double way);
  void search(const Particles<Dim>& s);

  /// `dt`: duration of the forces, s.
  void evaluate(const Particles<Dim>& s, double dt, int threads);

  /// Greatest stiffness relative to the material, at least 1, as last evaluated.
  double stiffening() const { return mechanism_->stiffening(); }

  /// N (per metre depth in 2D), as last evaluated. Requires `acting`.
  const V& force(int i) const { return force_[i]; }

  /// Impulse law: calls `change(i, impulse)`, N s (per metre depth in 2D), for touching particles, with impulses from
  /// the state before the first call. They act where the forces acted, `gone`, s, before the present positions, which
  /// conserves angular momentum. `inverse_mass(i)` in 1/kg, 0 for immovable particles.
  template <class InverseMass, class Change>
  void stop_approach(const Particles<Dim>& s, double gone, const InverseMass& inverse_mass,
                     const Change& change) {
    if (!mechanism_->has_impulses()) return;
    inverse_mass_.resize(s.size());
    for (const int i : mechanism_->touching()) inverse_mass_[i] = inverse_mass(i);
    find_impulses(s, gone);
    for (const int i : mechanism_->touching()) change(i, impulse_[i]);
  }

  /// Impulse by body `other`, or by `wall` if ≥ 0, in the last step, N s (per metre depth in 2D); only for probes.
  V impulse(int body, int other, int wall) const;

  /// Total impulses of walls on bodies.
  const Impulse& of_walls() const { return walls_.given(); }

  /// J (per metre depth in 2D); 0 for impulses.
  double energy(const Particles<Dim>& s) const { return mechanism_->energy(s, walls_); }

  /// Pairs of two bodies, for probes.
  Neighbors neighbors(int particles) const { return mechanism_->neighbors(particles); }
  /// Null if gaps are measured between particles.
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
    V impulse;  // N s, last step
  };
  void reset_forces(int particles) { force_.assign(acting() ? particles : 0, V{}); }
  void find_impulses(const Particles<Dim>& s, double gone);

  bool between_bodies_ = false;
  WallContacts<Dim> walls_;
  std::unique_ptr<ContactMechanism<Dim>> mechanism_;
  ContactsOfFaces<Dim>* faces_ = nullptr;  // mechanism or null
  std::vector<V> force_;                   // N
  std::vector<double> inverse_mass_;       // 1/kg
  std::vector<V> impulse_;                 // N s
  std::vector<Probed> probed_;
};

}  // namespace taut
