#pragma once

#include <algorithm>

#include "engine/core/columns.hpp"

namespace taut {

/// Computes new velocities from internal, contact and external forces. Plain data for passes; made by Common::kick.
template <int Dim>
struct Kick {
  using V = Vec<double, Dim>;

  double dt;  // s
  int size;   // particles
  V *x, *v;   // m, m/s
  const double *m, *mobile;
  const V* contact;  // [i] N; null: no contact
  V* impulse;        // [i] N s, for reaction probes; null: none needed
  void* outside;
  /// Adds loads, guides and drives to `v`, the new velocity of particle i without them; null if the scene has none.
  void (*act)(void* outside, int i, double dt, V& v);

  [[gnu::always_inline]] const V& by_acceleration(int i, V a) const {
    if (contact) a += (1 / m[i]) * contact[i];
    if (impulse) impulse[i] += (dt * m[i]) * a;
    V next = v[i];
    next += (dt * mobile[i]) * a;
    return take(i, next);
  }

  /// Adds contact forces to the forces of four particles from `first` on; the last group may be incomplete.
  [[gnu::always_inline]] void add_contact(int first, Vec<Pack, Dim>& force) const {
    if (!contact) return;
    const double* const of_contact = &contact[first][0];
    Pack rows[Dim], columns[Dim];
    for (int k = 0, left = Dim * (size - first); k < Dim; ++k, left -= lanes)
      rows[k] = left >= lanes ? load(of_contact + lanes * k) : load(of_contact + lanes * k, left);
    separate(rows, columns);
    for (int k = 0; k < Dim; ++k) force[k] += columns[k];
  }
  /// Records internal and contact impulses for reaction probes, before particles move. Requires `impulse`. `force` in
  /// N.
  void note(int first, Vec<Pack, Dim> force) const {
    if (contact) force += four_of(contact + first, size - first);
    for (int lane = 0; lane < std::min(lanes, size - first); ++lane)
      impulse[first + lane] += dt * lane_of(force, lane);
  }
  /// Adds `change` to v of four particles, then moves x by `after`, s, times the new v. Returns v² of each, m²/s².
  /// The last group may be incomplete.
  [[gnu::always_inline]] Pack by_changes(int first, const Pack (&change)[Dim], double after) const {
    Pack rows[Dim], columns[Dim], v2{};
    if (act || first + lanes > size) {
      for (int lane = 0; lane < lanes && first + lane < size; ++lane) {
        V next = v[first + lane];
        for (int k = 0; k < Dim; ++k) next[k] += change[k][lane];
        x[first + lane] += after * take(first + lane, next);
        v2[lane] = dot(v[first + lane], v[first + lane]);
      }
      return v2;
    }
    interleave(change, rows);
    double* const x_at = reinterpret_cast<double*>(&x[first]);  // of `lanes` particles, row by row
    double* const v_at = reinterpret_cast<double*>(&v[first]);
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) {
      rows[k] += load(v_at + lanes * k);
      store(rows[k], v_at + lanes * k);
      store(load(x_at + lanes * k) + after * rows[k], x_at + lanes * k);
    }
    separate(rows, columns);
    for (const Pack& of_four : columns) v2 += of_four * of_four;
    return v2;
  }
  /// Advances v of four particles by `force` and contact; x stays. `mobility` = mobile/m, 1/kg.
  [[gnu::always_inline]] Vec<Pack, Dim> by_forces(int first, const Pack& mobility,
                                                  Vec<Pack, Dim> force) const {
    if (contact) force += four_of(contact + first, size - first);
    Vec<Pack, Dim> next = four_of(v + first, size - first);
    next += (dt * mobility) * force;
    for (int lane = 0; act && lane < std::min(lanes, size - first); ++lane) {
      V own = lane_of(next, lane);
      act(outside, first + lane, dt, own);
      set_lane(next, lane, own);
    }
    put_four(next, v + first, size - first);
    return next;
  }

 private:
  [[gnu::always_inline]] const V& take(int i, V next) const {
    if (act) act(outside, i, dt, next);
    return v[i] = next;
  }
};

/// Constraints of guides and drives on velocities, for passes.
template <int Dim>
struct Steering {
  static constexpr unsigned char driven = 1 << 7;

  const unsigned char* axes;  // [id] bit k: guided along axis k; or `driven`. Null: none

  bool drives(int id) const { return axes && (axes[id] & driven) != 0; }
  /// Sets the guided components of `v` to 0. The particle must not be driven.
  void hold(int id, Vec<double, Dim>& v) const {
    if (!axes) return;
    for (int k = 0; k < Dim; ++k)
      if (axes[id] >> k & 1) v[k] = 0;
  }
};

}  // namespace taut
