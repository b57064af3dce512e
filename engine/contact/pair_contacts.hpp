#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/contact/contact_mechanism.hpp"
#include "engine/contact/pair_candidates.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// Contact of particles less than a spacing apart, of two bodies or of distant parts of one body. Departures of
/// `stop_approach` from [Khayyer2024] Eq. 53–54: the approach of the new velocities is stopped, since pressed faces
/// would otherwise creep into each other; the contact distance is one spacing, as the paper gives none.
template <int Dim>
class PairContacts final : public ContactMechanism<Dim> {
 public:
  using V = Vec<double, Dim>;
  using ContactMechanism<Dim>::touching_;

  PairContacts(const SolverInput& input, const ContactLawRow& law, bool between_bodies);

  bool search(const Particles<Dim>& s, const WallContacts<Dim>& walls, std::optional<double> way) override;

  void evaluate(const Particles<Dim>& s, double dt, WallContacts<Dim>& walls, std::vector<V>& force,
                int threads) override;
  double energy(const Particles<Dim>& s, const WallContacts<Dim>& walls) override;
  /// Shortens steps above a stiffness of 6, which is 4 times `spare` in Common::fixed_or_stable_step.
  double stiffening() const override {
    return law_.force && !touching_.empty() ? std::max(1.0, stiffness_ / 4) : 1;
  }
  V between(const Particles<Dim>& s, int a, int b) const override;
  V of_wall(const Particles<Dim>& s, int a, int wall, const WallContacts<Dim>& walls) const override;

  bool has_impulses() const override { return law_.impulse != nullptr; }
  void stop_approach(const Particles<Dim>& s, double gone, WallContacts<Dim>& walls,
                     const std::vector<V>& inverse_mass, std::vector<V>& impulse) override;
  V impulse(int body, int other, int wall) const override;

  Neighbors neighbors(int particles) const override { return candidates_.neighbors(particles); }

  void serialize(Saver& archive, int particles, const WallContacts<Dim>& walls) override {
    candidates_.serialize(archive, particles, walls.count());
  }
  void serialize(Loader& archive, int particles, const WallContacts<Dim>& walls) override {
    candidates_.serialize(archive, particles, walls.count());
    touching_ = candidates_.particles(particles);
  }

 private:
  /// Contact modulus, Pa.
  double modulus(const Particles<Dim>& s, int i, int j) const;
  template <class F>
  void for_each_touch(const Particles<Dim>& s, int i, double gone, const F& f) const;
  template <class F>
  void for_each_wall_touch(const Particles<Dim>& s, const WallContacts<Dim>& walls, double gone,
                           const F& f) const;
  int bodies() const { return static_cast<int>(recorded_impulses_.size()); }
  void record_impulse(int body, int other, const V& impulse) {
    if (!recorded_impulses_.empty()) recorded_impulses_[body][other] += impulse;
  }

  const ContactLawRow& law_;
  double dp_;              // m
  double stiffness_;       // contact modulus over K1 K2/(K1 + K2)
  std::vector<double> K_;  // [id] Pa
  PairCandidates<Dim> candidates_;
  std::vector<std::vector<V>> recorded_impulses_;  // [body][other body, then wall] N s
};

}  // namespace taut
