#pragma once

#include <cmath>
#include <vector>

#include "engine/solver/body_contacts.hpp"
#include "engine/solver/solver.hpp"
#include "engine/solver/state.hpp"
#include "engine/terms/impulse_contact.hpp"
#include "engine/terms/penalty_contact.hpp"

namespace taut::inline TAUT_ISA {

/// Forces between particles of two bodies that are less than one spacing apart, by the penalty or the impulse
/// law. They act along the pair and are equal and opposite to the last bit. With one body, or with the law
/// `sph`, which is the solver's own business, it is not `active` and costs nothing.
///
/// Once a step: `prepare`; the positions go to where the forces are wanted; `evaluate`; then each particle
/// takes its `force`. A solver that stores its particles in another order calls `search` after that.
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

  /// The forces at the positions that `s` has now; the impulse law stops the velocities that it has now
  /// within `dt`, s. On one thread: a touching face has too few particles for a second one.
  void evaluate(const State<Dim>& s, double dt) {
    for (const int i : touching_) {
      V force{};
      for (int k = pairs_.begin[i]; k < pairs_.begin[i + 1]; ++k) {
        const int j = pairs_.j[k];
        const V d = s.x[i] - s.x[j];
        const double r = std::sqrt(dot(d, d));
        if (r > 0 && r < dp_) force += (pair_force(s, i, j, r, dt) / r) * d;
      }
      force_[i] = force;
    }
  }

  /// On particle i, N (per metre depth in 2D), as last evaluated.
  const V& force(int i) const { return force_[i]; }

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

  double pair_force(const State<Dim>& s, int i, int j, double r, double dt) const {  // N, parts them if > 0
    if (law_ == ContactLaw::penalty) return penalty_force(r, dp_, modulus(s, i, j), Dim);
    const double closing_speed = -dot(s.v[i] - s.v[j], s.x[i] - s.x[j]) / r;
    return impulse_force(closing_speed, s.mobile[i] / s.m[i], s.mobile[j] / s.m[j], dt);
  }

  ContactLaw law_;
  bool active_;
  double dp_;              // m
  double stiffness_;       // of the penalty, over K1 K2/(K1 + K2)
  std::vector<double> K_;  // [id] Pa
  BodyContacts<Dim> pairs_;
  std::vector<int> touching_;  // particles that have pairs
  std::vector<V> force_;       // N
  double travelled_ = 0;       // by the fastest particle since the last search, m
};

}  // namespace taut::inline TAUT_ISA
