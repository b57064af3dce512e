#pragma once

#include <optional>
#include <type_traits>
#include <vector>

#include "engine/contact/wall_contacts.hpp"
#include "engine/core/archive.hpp"
#include "engine/core/tensor.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/solver/particles.hpp"

namespace taut {

class FaceContacts;
class FacetContacts;
template <int Dim>
using ContactsOfFaces = std::conditional_t<Dim == 3, FacetContacts, FaceContacts>;

/// Mechanism by which bodies, folds of one body and walls act on each other: between particles
/// (pair_contacts.hpp), between faces (face_contacts.hpp, in 3D facet_contacts.hpp), or none, which is this class.
///
/// Each mechanism has three parts. A search lists candidates, which may touch before the next search. The geometry
/// selects the candidates that touch now, with direction, distance or depth, area and weights. A law
/// (terms/contact_laws.hpp) gives the force, energy or impulse of what touches.
template <int Dim>
class ContactMechanism {
 public:
  using V = Vec<double, Dim>;

  /// Range of the pairs that probes of a gap see, in spacings.
  static constexpr double reach = 2;

  virtual ~ContactMechanism() = default;

  /// Lists the candidates if the fastest particle, moving `way`, m, next, may leave the range of the last search, or if
  /// there is no `way`: particles have been stored in another order. Returns whether it searched.
  virtual bool search(const Particles<Dim>& /*particles*/, const WallContacts<Dim>& /*walls*/,
                      std::optional<double> /*way*/) {
    return false;
  }
  /// Particles that may get a force before the next search, in rising order.
  const std::vector<int>& touching() const { return touching_; }

  /// Sets the forces on `touching`, N (per metre depth in 2D), and books what walls give in `dt`, s.
  virtual void evaluate(const Particles<Dim>& /*particles*/, double /*dt*/, WallContacts<Dim>& /*walls*/,
                        std::vector<V>& /*force*/, int /*threads*/) {}
  /// J (per metre depth in 2D).
  virtual double energy(const Particles<Dim>&, const WallContacts<Dim>&) { return 0; }
  /// Largest ratio of the stiffness of a contact to the stiffness of the material, 1 at least, as last evaluated.
  virtual double stiffening() const { return 1; }
  /// Force on body `a` of body `b` or of a wall, N (per metre depth in 2D), as last evaluated.
  virtual V between(const Particles<Dim>& /*particles*/, int /*a*/, int /*b*/) const { return {}; }
  virtual V of_wall(const Particles<Dim>& /*particles*/, int /*a*/, int /*wall*/,
                    const WallContacts<Dim>& /*walls*/) const {
    return {};
  }

  /// The law gives impulses and no forces.
  virtual bool has_impulses() const { return false; }
  /// Sets the impulses on `touching`, N s (per metre depth in 2D); see Contact::stop_approach. `inverse_mass` of
  /// each particle in `touching`, 1/kg.
  virtual void stop_approach(const Particles<Dim>& /*particles*/, double /*dt*/, WallContacts<Dim>& /*walls*/,
                             const std::vector<double>& /*inverse_mass*/, std::vector<V>& /*impulse*/) {}
  /// Impulse on a body of another body, or of a wall if `wall` is not negative, in the last step, N s.
  virtual V impulse(int /*a*/, int /*b*/, int /*wall*/) const { return {}; }

  /// Pairs of two bodies in the form in which probes look for neighbours.
  virtual Neighbors neighbors(int particles) const {
    Neighbors none;
    none.begin.assign(particles + 1, 0);
    return none;
  }

  virtual void serialize(Saver&, int, const WallContacts<Dim>&) {}
  virtual void serialize(Loader&, int, const WallContacts<Dim>&) {}

 protected:
  std::vector<int> touching_;
};

}  // namespace taut
