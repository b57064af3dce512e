#pragma once

#include <memory>
#include <vector>

#include "engine/contact/contact_mechanism.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// Contact of bodies, folds and walls. Forces in N, impulses in N s, energies in J (per metre depth in 2D).
/// In each step call `prepare` before positions change, `evaluate` wherever forces are needed, then `stop_approach`.
/// Add `force` if `acting`. After particles are reordered, call `search`.
template <int Dim>
class Contact {
 public:
  using V = Vec<double, Dim>;

  static constexpr double reach = ContactMechanism<Dim>::reach;

  explicit Contact(const SolverInput& input);

  bool between_bodies() const { return between_bodies_; }
  bool acting() const { return !mechanism_->touching().empty(); }

  /// Searches unless the last search still covers a motion by `way` (in m). Returns whether it searched.
  bool prepare(const Particles<Dim>& s, double way);
  void search(const Particles<Dim>& s);

  /// Forces at the current positions and their impulses over `dt` (in s).
  void evaluate(const Particles<Dim>& s, double dt, int threads);

  /// Stiffness of face contact relative to the material, at least 1; otherwise 1.
  double stiffening() const { return mechanism_->stiffening(); }

  /// Last evaluated. Requires `acting`.
  const V& force(int i) const { return force_[i]; }

  /// Calls `change(i, impulse)` for touching particles if the law has impulses. To conserve angular momentum, impulses
  /// act at the positions of `gone` seconds ago, as the forces did. `inverse_mass(i)`: [axis] 1/kg, 0 if immovable.
  template <class InverseMass, class Change>
  void stop_approach(const Particles<Dim>& s, double gone, const InverseMass& inverse_mass,
                     const Change& change) {
    if (!mechanism_->has_impulses()) return;
    inverse_mass_.resize(s.size());
    for (const int i : mechanism_->touching()) inverse_mass_[i] = inverse_mass(i);
    find_impulses(s, gone);
    for (const int i : mechanism_->touching()) change(i, impulse_[i]);
  }

  /// Impulse on `body` in the last step by body `other`, or by `wall` if `wall` ≥ 0; 0 without a probe.
  V impulse(int body, int other, int wall) const;

  const Impulse& of_walls() const { return walls_.recorded_impulse(); }

  double energy(const Particles<Dim>& s) const { return mechanism_->energy(s, walls_); }

  Neighbors neighbors(int particles) const { return mechanism_->neighbors(particles); }
  /// Faces from which gaps are measured; may be null.
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
    V impulse;  // last step
  };
  void reset_forces(int particles) { force_.assign(acting() ? particles : 0, V{}); }
  void find_impulses(const Particles<Dim>& s, double gone);

  bool between_bodies_ = false;
  WallContacts<Dim> walls_;
  std::unique_ptr<ContactMechanism<Dim>> mechanism_;
  ContactsOfFaces<Dim>* faces_ = nullptr;
  std::vector<V> force_;
  std::vector<V> inverse_mass_;  // 1/kg
  std::vector<V> impulse_;
  std::vector<Probed> probed_;
};

}  // namespace taut
