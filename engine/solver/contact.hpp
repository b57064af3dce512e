#pragma once

#include <cmath>
#include <vector>

#include "engine/solver/body_contacts.hpp"
#include "engine/solver/solver.hpp"
#include "engine/solver/state.hpp"
#include "engine/terms/impulse_contact.hpp"
#include "engine/terms/penalty_contact.hpp"

namespace taut::inline TAUT_ISA {

/// What particles of two bodies do to each other that are less than one spacing apart, by the penalty or the
/// impulse law. It acts along the pair and is equal and opposite to the last bit. With one body, or with the
/// law `sph`, which is the solver's own business, it is not `active` and costs nothing.
///
/// Once a step: `prepare`; the positions go to where forces are wanted; `evaluate`; each particle takes its
/// `force` (penalty) for its new velocity; `stop_approach` changes the new velocities of those that meet
/// (impulse). A solver that stores its particles in another order calls `search` after that.
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
      : law_(input.contact),
        active_(law_ != ContactLaw::sph && input.layout.first.size() > 2),
        dp_(input.constants.dp),
        stiffness_(input.constants.contact_stiffness),
        pairs_(reach * dp_, 0.5 * dp_) {
    if (!active_ || law_ != ContactLaw::penalty) return;
    for (const int material : input.layout.material) K_.push_back(input.materials[material].K);
  }

  bool active() const { return active_; }

  /// Searches anew once the fastest particle, whose next way is `way`, m, may have come out of the last
  /// search's reach. True if it did.
  bool prepare(const State<Dim>& s, double way) {
    if (!active_) return false;
    travelled_ += way;
    if (travelled_ <= pairs_.lasts_for()) return false;
    search(s);
    return true;
  }

  void search(const State<Dim>& s) {
    if (!active_) return;
    travelled_ = 0;
    pairs_.search(s);
    touching_.clear();
    for (int i = 0; i < s.size(); ++i)
      if (pairs_.begin[i] < pairs_.begin[i + 1]) touching_.push_back(i);
    force_.assign(s.size(), V{});
  }

  /// The forces of the penalty law at the positions that `s` has now. On one thread: a touching face has too
  /// few particles for a second one.
  void evaluate(const State<Dim>& s) {
    if (law_ != ContactLaw::penalty) return;
    for (const int i : touching_) {
      force_[i] = V{};
      for_each_touch(s, i, 0, [&](int j, const V& d, double r) {
        force_[i] += (penalty_force(r, dp_, modulus(s, i, j), Dim) / r) * d;
      });
    }
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
    impulse_.assign(touching_.size(), V{});
    for (std::size_t k = 0; k < touching_.size(); ++k) {
      const int i = touching_[k];
      for_each_touch(s, i, gone, [&](int j, const V& d, double r) {
        const double closing_speed = -dot(s.v[i] - s.v[j], d) / r;
        impulse_[k] += (stopping_impulse(closing_speed, inverse_mass(i), inverse_mass(j)) / r) * d;
      });
    }
    for (std::size_t k = 0; k < touching_.size(); ++k) change(touching_[k], impulse_[k]);
  }

  /// Of all contacts at the positions that `s` has now, J (per metre depth in 2D). Impulses have none.
  double energy(const State<Dim>& s) const {
    double twice = 0;
    if (law_ != ContactLaw::penalty) return twice;
    for (const int i : touching_) {
      for (int k = pairs_.begin[i]; k < pairs_.begin[i + 1]; ++k) {
        const V d = s.x[i] - s.x[pairs_.j[k]];
        twice += penalty_energy(std::sqrt(dot(d, d)), dp_, modulus(s, i, pairs_.j[k]), Dim);
      }
    }
    return 0.5 * twice;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(pairs_, touching_, force_, travelled_);
  }

  /// The pairs in the form in which probes look for neighbours.
  Neighbors neighbors(int particles) const {
    Neighbors out;
    out.begin.push_back(0);
    for (int i = 0; i < particles; ++i) {
      if (active_)
        out.j.insert(out.j.end(), pairs_.j.begin() + pairs_.begin[i], pairs_.j.begin() + pairs_.begin[i + 1]);
      while (out.j.size() % lanes != 0) out.j.push_back(i);
      out.begin.push_back(static_cast<int>(out.j.size()) / lanes);
    }
    return out;
  }

 private:
  double modulus(const State<Dim>& s, int i, int j) const {  // Pa
    return contact_modulus(K_[s.id[i]], K_[s.id[j]], stiffness_);
  }

  /// f(j, x_ij, r) for each particle of another body less than a spacing from i, as it was `gone` seconds
  /// ago.
  template <class F>
  void for_each_touch(const State<Dim>& s, int i, double gone, const F& f) const {
    for (int k = pairs_.begin[i]; k < pairs_.begin[i + 1]; ++k) {
      const int j = pairs_.j[k];
      const V d = (s.x[i] - s.x[j]) - gone * (s.v[i] - s.v[j]);
      const double r = std::sqrt(dot(d, d));
      if (r > 0 && r < dp_) f(j, d, r);
    }
  }

  ContactLaw law_;
  bool active_;
  double dp_;              // m
  double stiffness_;       // of the penalty, over K1 K2/(K1 + K2)
  std::vector<double> K_;  // [id] Pa
  BodyContacts<Dim> pairs_;
  std::vector<int> touching_;  // particles that have pairs
  std::vector<V> force_;       // N
  std::vector<V> impulse_;     // of touching_, N s
  double travelled_ = 0;       // by the fastest particle since the last search, m
};

}  // namespace taut::inline TAUT_ISA
