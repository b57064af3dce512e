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

/// Contact between particles, between faces, or none.
template <int Dim>
class ContactMechanism {
 public:
  using V = Vec<double, Dim>;

  static constexpr double reach = 2;  // range of gap probes between particles, in spacings

  virtual ~ContactMechanism() = default;

  /// See Contact::prepare. An empty `way` forces a search.
  virtual bool search(const Particles<Dim>& /*particles*/, const WallContacts<Dim>& /*walls*/,
                      std::optional<double> /*way*/) {
    return false;
  }
  /// Particles that may touch before the next search, ascending.
  const std::vector<int>& touching() const { return touching_; }

  /// Sets the forces (in N) on `touching` particles and records the impulses of walls over `dt` (in s).
  virtual void evaluate(const Particles<Dim>& /*particles*/, double /*dt*/, WallContacts<Dim>& /*walls*/,
                        std::vector<V>& /*force*/, int /*threads*/) {}
  virtual double energy(const Particles<Dim>&, const WallContacts<Dim>&) { return 0; }
  virtual double stiffening() const { return 1; }
  virtual V between(const Particles<Dim>& /*particles*/, int /*a*/, int /*b*/) const { return {}; }
  virtual V of_wall(const Particles<Dim>& /*particles*/, int /*a*/, int /*wall*/,
                    const WallContacts<Dim>& /*walls*/) const {
    return {};
  }

  virtual bool has_impulses() const { return false; }
  /// See Contact::stop_approach. `inverse_mass`: [particle][axis] 1/kg.
  virtual void stop_approach(const Particles<Dim>& /*particles*/, double /*gone*/,
                             WallContacts<Dim>& /*walls*/, const std::vector<V>& /*inverse_mass*/,
                             std::vector<V>& /*impulse*/) {}
  virtual V impulse(int /*a*/, int /*b*/, int /*wall*/) const { return {}; }

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
