#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/solver/contact/body_contacts.hpp"
#include "engine/solver/contact/own_pairs.hpp"
#include "engine/solver/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/terms/impulse_contact.hpp"
#include "engine/terms/lennard_jones_contact.hpp"
#include "engine/terms/penalty_contact.hpp"

namespace taut::inline TAUT_ISA {

/// What particles of two bodies, or of two parts of one (own_pairs.hpp), do to each other that are less than
/// one spacing apart, by a law of forces (penalty, lennard_jones) or the impulse law. It acts along the pair
/// and is equal and opposite to the last bit.
///
/// Differs from [Khayyer2024] Eq. 53–54: there the impulses are a force in the momentum equation that stops
/// the approach of the old velocities, and what the step itself adds goes on, unstopped. Under a pressure p
/// that is a dashpot, not a stop: faces creep into each other at about p/(ρ c0) whatever the resolution. On
/// rings that meet at 0.06 c0 they got 0.96 dp deep at once, interlocked, and never came apart. Here the new
/// velocities are stopped before any position follows them.
/// The paper does not say at which distance contact acts: one spacing, that of two layers of a body.
template <int Dim>
class PairContacts {
 public:
  using V = Vec<double, Dim>;

  /// Pairs of bodies are known up to here, beyond where they act, so that probes see a gap before it closes;
  /// spacings.
  static constexpr double reach = 2;

  explicit PairContacts(const SolverInput& input)
      : between_bodies_(input.contact != ContactLaw::sph && input.contact != ContactLaw::surface &&
                        input.initial.first.size() > 2),
        law_(input.contact == ContactLaw::sph ? ContactLaw::penalty : input.contact),
        dp_(input.constants.dp),
        stiffness_(input.constants.contact_stiffness),
        pairs_(reach * dp_, skin * dp_),
        own_(input, dp_) {
    const auto by_contact = [](const Probe& probe) { return probe.kind == Probe::Kind::contact_force; };
    const std::size_t bodies = input.scene.bodies.size();
    if (impulses() && std::ranges::any_of(input.scene.probes, by_contact))
      given_.assign(bodies, std::vector<V>(bodies + input.scene.walls.size()));
    for (const int material : input.initial.material) K_.push_back(input.materials[material].K);
  }

  bool impulses() const { return law_ == ContactLaw::impulse; }

  void search(const Particles<Dim>& s, WallContacts<Dim>& walls) {
    search_others(s, walls);
    own_.search(s);
    list_touching(s, walls);
  }
  /// Searches what has to be, before the fastest particle goes by `way`, m: true if there was something.
  bool prepare(const Particles<Dim>& s, WallContacts<Dim>& walls, double way) {
    bool others = false;
    if (between_bodies_ || walls.any()) {
      travelled_ += way;
      others = travelled_ > pairs_.lasts_for();
    }
    const bool own = own_.prepare(s, way);
    if (others) search_others(s, walls);
    if (others || own) list_touching(s, walls);
    return others || own;
  }

  /// Particles that have pairs or are near a wall, in rising order.
  const std::vector<int>& touching() const { return touching_; }

  /// Sets the forces on `touching`, N (per metre depth in 2D); what walls give in `dt`, s, is booked. On one
  /// thread: a touching face has too few particles for a second one.
  void evaluate(const Particles<Dim>& s, double dt, WallContacts<Dim>& walls, std::vector<V>& force) const {
    if (impulses()) return;
    for (const int i : touching_) {
      force[i] = V{};
      for_each_touch(s, i, 0,
                     [&](int j, const V& d, double r) { force[i] += (push(r, modulus(s, i, j)) / r) * d; });
    }
    walls.for_each_touch(s, dp_, 0, [&](int i, int wall, const V& x, double r) {
      const V f = push(r, modulus(s, i, i)) * walls.normal(wall);
      force[i] += f;
      walls.book(x, (dt * s.mobile[i]) * f);
    });
  }

  /// See Contact::stop_approach.
  template <class InverseMass, class Change>
  void stop_approach(const Particles<Dim>& s, double gone, WallContacts<Dim>& walls,
                     const InverseMass& inverse_mass, const Change& change) {
    impulse_.resize(s.size());
    for (std::vector<V>& given : given_) std::ranges::fill(given, V{});
    for (const int i : touching_) {
      impulse_[i] = V{};
      for_each_touch(s, i, gone, [&](int j, const V& d, double r) {
        const double closing_speed = -dot(s.v[i] - s.v[j], d) / r;
        const V impulse = (stopping_impulse(closing_speed, inverse_mass(i), inverse_mass(j)) / r) * d;
        impulse_[i] += impulse;
        note(s.body[i], s.body[j], impulse);
      });
    }
    walls.for_each_touch(s, dp_, gone, [&](int i, int wall, const V& x, double) {
      const V& normal = walls.normal(wall);
      const V impulse = stopping_impulse(-dot(s.v[i], normal), inverse_mass(i), 0) * normal;
      impulse_[i] += impulse;
      note(s.body[i], bodies() + wall, impulse);
      walls.book(x, impulse);
    });
    for (const int i : touching_) change(i, impulse_[i]);
  }

  double energy(const Particles<Dim>& s, const WallContacts<Dim>& walls) const {
    double twice = 0;  // each pair is seen from both sides, and half of one with an image counts
    if (impulses()) return twice;
    for (const int i : touching_)
      for_each_touch(s, i, 0, [&](int j, const V&, double r) { twice += stored(r, modulus(s, i, j)); });
    walls.for_each_touch(s, dp_, 0, [&](int i, int, const V&, double r) {
      twice += s.mobile[i] * stored(r, modulus(s, i, i));
    });
    return 0.5 * twice;
  }

  /// On body `a` of body `b`, N (per metre depth in 2D), at the positions that `s` has now.
  V between(const Particles<Dim>& s, int a, int b) const {
    V sum{};
    if (impulses()) return sum;
    for (const int i : touching_) {
      if (s.body[i] != a) continue;
      for_each_touch(s, i, 0, [&](int j, const V& d, double r) {
        if (s.body[j] == b) sum += (push(r, modulus(s, i, j)) / r) * d;
      });
    }
    return sum;
  }
  /// The same of a wall.
  V of_wall(const Particles<Dim>& s, int a, int wall, const WallContacts<Dim>& walls) const {
    double sum = 0;
    if (impulses()) return {};
    walls.for_each_touch(s, dp_, 0, [&](int i, int met, const V&, double r) {
      if (met == wall && s.body[i] == a) sum += push(r, modulus(s, i, i));
    });
    return sum * walls.normal(wall);
  }

  /// What `body` was given in the last step of impulses by `other`, or by a wall where that is not below 0, N
  /// s.
  const V& given(int body, int other, int wall) const {
    return given_[body][wall < 0 ? other : bodies() + wall];
  }

  /// The pairs of two bodies in the form in which probes look for neighbours.
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

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    pairs_.serialize(archive, particles);
    own_.serialize(archive, particles);
    archive.indices(touching_, particles);
    archive(travelled_);
  }

 private:
  /// Longer: fewer searches, more pairs; in spacings.
  static constexpr double skin = 0.5;

  void search_others(const Particles<Dim>& s, WallContacts<Dim>& walls) {
    travelled_ = 0;
    if (between_bodies_) pairs_.search(s);
    walls.search(s, (1 + 2 * skin) * dp_);
  }
  void list_touching(const Particles<Dim>& s, const WallContacts<Dim>& walls) {
    touching_.clear();
    for (int i = 0; i < s.size(); ++i)
      if ((between_bodies_ && pairs_.begin[i] < pairs_.begin[i + 1]) ||
          (!own_.begin.empty() && own_.begin[i] < own_.begin[i + 1]))
        touching_.push_back(i);
    for (const auto& [i, wall] : walls.near()) touching_.push_back(i);
    std::sort(touching_.begin(), touching_.end());
    touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
  }

  /// N (per metre depth in 2D), of two particles r apart whose contact has this modulus.
  double push(double r, double modulus) const {
    return law_ == ContactLaw::lennard_jones ? lennard_jones_force(r, dp_, modulus, Dim)
                                             : penalty_force(r, dp_, modulus, Dim);
  }
  double stored(double r, double modulus) const {  // J (per metre depth in 2D)
    return law_ == ContactLaw::lennard_jones ? lennard_jones_energy(r, dp_, modulus, Dim)
                                             : penalty_energy(r, dp_, modulus, Dim);
  }
  double modulus(const Particles<Dim>& s, int i, int j) const {  // Pa
    return contact_modulus(K_[s.id[i]], K_[s.id[j]], stiffness_);
  }

  int bodies() const { return static_cast<int>(given_.size()); }
  void note(int body, int other, const V& impulse) {
    if (!given_.empty()) given_[body][other] += impulse;
  }

  /// f(j, x_ij, r) for each particle that i touches, as it was `gone` seconds ago.
  template <class F>
  void for_each_touch(const Particles<Dim>& s, int i, double gone, const F& f) const {
    const auto visit = [&](const auto& list) {
      for (int k = list.begin[i]; k < list.begin[i + 1]; ++k) {
        const int j = list.j[k];
        const V d = (s.x[i] - s.x[j]) - gone * (s.v[i] - s.v[j]);
        const double r = std::sqrt(dot(d, d));
        if (r > 0 && r < dp_) f(j, d, r);
      }
    };
    if (between_bodies_) visit(pairs_);
    if (!own_.begin.empty()) visit(own_);
  }

  bool between_bodies_;
  ContactLaw law_;         // of pairs, if any are here, and of walls
  double dp_;              // m
  double stiffness_;       // over K1 K2/(K1 + K2)
  std::vector<double> K_;  // [id] Pa
  BodyContacts<Dim> pairs_;
  OwnPairs<Dim> own_;
  std::vector<int> touching_;
  std::vector<V> impulse_;  // N s
  std::vector<std::vector<V>>
      given_;             // [body][body, then wall] N s in the last step; empty where no probe asks
  double travelled_ = 0;  // by the fastest particle since the last search, m
};

}  // namespace taut::inline TAUT_ISA
