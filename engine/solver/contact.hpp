#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/solver/body_contacts.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/solver/state.hpp"
#include "engine/solver/wall_contacts.hpp"
#include "engine/terms/impulse_contact.hpp"
#include "engine/terms/lennard_jones_contact.hpp"
#include "engine/terms/penalty_contact.hpp"

namespace taut::inline TAUT_ISA {

/// What particles of two bodies do to each other that are less than one spacing apart, by a law of forces
/// (penalty, lennard_jones) or the impulse law, and what walls do to them. It acts along the pair and is
/// equal and opposite to the last bit. With one body, or with the law `sph`, which is the solver's own
/// business, and without walls it is not `active` and costs nothing.
///
/// Once a step: `prepare`; the positions go to where forces are wanted; `evaluate`; each particle takes its
/// `force` for its new velocity; `stop_approach` changes the new velocities of those that meet (impulse). A
/// solver that stores its particles in another order calls `search` after that.
///
/// Differs from [Khayyer2024] Eq. 53–54: there the impulses are a force in the momentum equation that stops
/// the approach of the old velocities, and what the step itself adds goes on, unstopped. Under a pressure p
/// that is a dashpot, not a stop: faces creep into each other at about p/(ρ c0) whatever the resolution. On
/// rings that meet at 0.06 c0 they got 0.96 dp deep at once, interlocked, and never came apart. Here the new
/// velocities are stopped before any position follows them.
/// The paper does not say at which distance contact acts: one spacing, that of two layers of a body.
template <int Dim>
class Contact {
 public:
  using V = Vec<double, Dim>;

  /// Pairs are known up to here, beyond where they act, so that probes see a gap before it closes; spacings.
  static constexpr double reach = 2;

  explicit Contact(const SolverInput& input)
      : between_bodies_(input.contact != ContactLaw::sph && input.initial.first.size() > 2),
        law_(input.contact == ContactLaw::sph ? ContactLaw::penalty : input.contact),
        dp_(input.constants.dp),
        stiffness_(input.constants.contact_stiffness),
        pairs_(reach * dp_, skin * dp_),
        walls_(input.scene) {
    if (!active()) return;
    for (const int material : input.initial.material) K_.push_back(input.materials[material].K);
  }

  /// Particles of two bodies act on each other here, not as those of one.
  bool between_bodies() const { return between_bodies_; }
  bool active() const { return between_bodies_ || walls_.any(); }

  /// Searches anew once the fastest particle, whose next way is `way`, m, may have come out of the last
  /// search's reach. True if it did.
  bool prepare(const State<Dim>& s, double way) {
    if (!active()) return false;
    travelled_ += way;
    if (travelled_ <= pairs_.lasts_for()) return false;
    search(s);
    return true;
  }

  void search(const State<Dim>& s) {
    if (!active()) return;
    travelled_ = 0;
    touching_.clear();
    if (between_bodies_) {
      pairs_.search(s);
      for (int i = 0; i < s.size(); ++i)
        if (pairs_.begin[i] < pairs_.begin[i + 1]) touching_.push_back(i);
    }
    walls_.search(s, (1 + 2 * skin) * dp_);
    for (const auto& [i, wall] : walls_.near()) touching_.push_back(i);
    std::sort(touching_.begin(), touching_.end());
    touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
    force_.assign(s.size(), V{});
    impulse_.assign(s.size(), V{});
  }

  /// The forces at the positions that `s` has now, which act for `dt`, s. On one thread: a touching face has
  /// too few particles for a second one.
  void evaluate(const State<Dim>& s, double dt) {
    if (law_ == ContactLaw::impulse) return;
    for (const int i : touching_) {
      force_[i] = V{};
      for_each_touch(s, i, 0,
                     [&](int j, const V& d, double r) { force_[i] += (push(r, modulus(s, i, j)) / r) * d; });
    }
    walls_.for_each_touch(s, dp_, 0, [&](int i, const V& x, const V& normal, double r) {
      const V force = push(r, modulus(s, i, i)) * normal;
      force_[i] += force;
      walls_.book(x, (dt * s.mobile[i]) * force);
    });
  }

  /// On particle i, N (per metre depth in 2D), as last evaluated.
  const V& force(int i) const { return force_[i]; }

  /// Impulse law: `change(i, impulse)`, N s (per metre depth in 2D), for each touching particle, with the
  /// positions and velocities that `s` had before the first of them. The positions have followed the new
  /// velocities for `gone`, s, from where the forces of the step acted; there the impulses act too, so that
  /// they keep the angular momentum. `inverse_mass(i)`, 1/kg, is 0 for one that cannot be moved.
  template <class InverseMass, class Change>
  void stop_approach(const State<Dim>& s, double gone, const InverseMass& inverse_mass,
                     const Change& change) {
    if (law_ != ContactLaw::impulse) return;
    for (const int i : touching_) {
      impulse_[i] = V{};
      for_each_touch(s, i, gone, [&](int j, const V& d, double r) {
        const double closing_speed = -dot(s.v[i] - s.v[j], d) / r;
        impulse_[i] += (stopping_impulse(closing_speed, inverse_mass(i), inverse_mass(j)) / r) * d;
      });
    }
    walls_.for_each_touch(s, dp_, gone, [&](int i, const V& x, const V& normal, double) {
      const V impulse = stopping_impulse(-dot(s.v[i], normal), inverse_mass(i), 0) * normal;
      impulse_[i] += impulse;
      walls_.book(x, impulse);
    });
    for (const int i : touching_) change(i, impulse_[i]);
  }

  /// What walls have given to the bodies so far.
  const Impulse& of_walls() const { return walls_.given(); }

  /// Of all contacts at the positions that `s` has now, J (per metre depth in 2D). Impulses have none.
  double energy(const State<Dim>& s) const {
    double twice = 0;  // each pair is seen from both sides, and half of one with an image counts
    if (law_ == ContactLaw::impulse) return twice;
    for (const int i : touching_)
      for_each_touch(s, i, 0, [&](int j, const V&, double r) { twice += stored(r, modulus(s, i, j)); });
    walls_.for_each_touch(s, dp_, 0, [&](int i, const V&, const V&, double r) {
      twice += s.mobile[i] * stored(r, modulus(s, i, i));
    });
    return 0.5 * twice;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(pairs_, walls_, touching_, force_, impulse_, travelled_);
  }

  /// The pairs in the form in which probes look for neighbours.
  Neighbors neighbors(int particles) const {
    Neighbors out;
    out.begin.push_back(0);
    for (int i = 0; i < particles; ++i) {
      if (between_bodies_)
        out.j.insert(out.j.end(), pairs_.j.begin() + pairs_.begin[i], pairs_.j.begin() + pairs_.begin[i + 1]);
      while (out.j.size() % lanes != 0) out.j.push_back(i);
      out.begin.push_back(static_cast<int>(out.j.size()) / lanes);
    }
    return out;
  }

 private:
  /// Longer: fewer searches, more pairs; in spacings.
  static constexpr double skin = 0.5;

  /// N (per metre depth in 2D), of two particles r apart whose contact has this modulus.
  double push(double r, double modulus) const {
    return law_ == ContactLaw::lennard_jones ? lennard_jones_force(r, dp_, modulus, Dim)
                                             : penalty_force(r, dp_, modulus, Dim);
  }
  double stored(double r, double modulus) const {  // J (per metre depth in 2D)
    return law_ == ContactLaw::lennard_jones ? lennard_jones_energy(r, dp_, modulus, Dim)
                                             : penalty_energy(r, dp_, modulus, Dim);
  }
  double modulus(const State<Dim>& s, int i, int j) const {  // Pa
    return contact_modulus(K_[s.id[i]], K_[s.id[j]], stiffness_);
  }

  /// f(j, x_ij, r) for each particle of another body less than a spacing from i, as it was `gone` seconds
  /// ago.
  template <class F>
  void for_each_touch(const State<Dim>& s, int i, double gone, const F& f) const {
    if (!between_bodies_) return;
    for (int k = pairs_.begin[i]; k < pairs_.begin[i + 1]; ++k) {
      const int j = pairs_.j[k];
      const V d = (s.x[i] - s.x[j]) - gone * (s.v[i] - s.v[j]);
      const double r = std::sqrt(dot(d, d));
      if (r > 0 && r < dp_) f(j, d, r);
    }
  }

  bool between_bodies_;
  ContactLaw law_;         // of pairs, if any are here, and of walls
  double dp_;              // m
  double stiffness_;       // over K1 K2/(K1 + K2)
  std::vector<double> K_;  // [id] Pa
  BodyContacts<Dim> pairs_;
  WallContacts<Dim> walls_;
  std::vector<int> touching_;  // particles that have pairs or are near a wall, in rising order
  std::vector<V> force_;       // N
  std::vector<V> impulse_;     // N s
  double travelled_ = 0;       // by the fastest particle since the last search, m
};

/// Of a law of contact between bodies that is not `sph`.
constexpr const TermInfo& contact_info(ContactLaw law) {
  return law == ContactLaw::impulse         ? impulse_info
         : law == ContactLaw::lennard_jones ? lennard_jones_info
                                            : penalty_info;
}

}  // namespace taut::inline TAUT_ISA
