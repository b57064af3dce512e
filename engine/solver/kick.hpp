#pragma once

#include <algorithm>

#include "engine/core/columns.hpp"

namespace taut {

/// Change of the velocities by all forces.
template <int Dim>
struct Kick {
  using V = Vec<double, Dim>;

  double dt;  // s
  int size;
  V *x, *v;  // m, m/s
  const double *m, *mobile;
  const V* contact;  // [i] N; may be null
  V* impulse;        // [i] N s, for reaction probes; may be null
  void* outside;
  /// Applies external actions to `v`; may be null.
  void (*act)(void* outside, int i, double dt, V& v);

  [[gnu::always_inline]] const V& by_acceleration(int i, V a) const {
    if (contact) a += (1 / m[i]) * contact[i];
    if (impulse) impulse[i] += (dt * m[i]) * a;
    V next = v[i];
    next += (dt * mobile[i]) * a;
    return take(i, next);
  }

  [[gnu::always_inline]] void add_contact(int first, Vec<Pack, Dim>& force) const {
    if (!contact) return;
    const double* const of_contact = &contact[first][0];
    Pack rows[Dim], columns[Dim];
    for (int k = 0, left = Dim * (size - first); k < Dim; ++k, left -= lanes)
      rows[k] = left >= lanes ? load(of_contact + lanes * k) : load(of_contact + lanes * k, left);
    separate(rows, columns);
    for (int k = 0; k < Dim; ++k) force[k] += columns[k];
  }
  /// Records the impulses of `force` (internal forces, N) and of contact. Requires `impulse`.
  void record(int first, Vec<Pack, Dim> force) const {
    if (contact) force += load_four(contact + first, size - first);
    for (int lane = 0; lane < std::min(lanes, size - first); ++lane)
      impulse[first + lane] += dt * lane_of(force, lane);
  }
  /// Adds `change` and external actions to v of four particles, then moves x by `after` (in s) times v.
  /// Returns v², m²/s².
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
    double* const x_at = reinterpret_cast<double*>(&x[first]);
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
  /// Advances v by `force` (in N), contact and external actions. `mobility` = mobile/m, 1/kg.
  [[gnu::always_inline]] Vec<Pack, Dim> by_forces(int first, const Pack& mobility,
                                                  Vec<Pack, Dim> force) const {
    if (contact) force += load_four(contact + first, size - first);
    Vec<Pack, Dim> next = load_four(v + first, size - first);
    next += (dt * mobility) * force;
    for (int lane = 0; act && lane < std::min(lanes, size - first); ++lane) {
      V own = lane_of(next, lane);
      act(outside, first + lane, dt, own);
      set_lane(next, lane, own);
    }
    store_four(next, v + first, size - first);
    return next;
  }

 private:
  [[gnu::always_inline]] const V& take(int i, V next) const {
    if (act) act(outside, i, dt, next);
    return v[i] = next;
  }
};

template <int Dim>
struct Steering {
  static constexpr unsigned char driven = 1 << 7;

  const unsigned char* axes;  // [id] bit k: a guide constrains axis k; or `driven`; may be null

  bool drives(int id) const { return axes && (axes[id] & driven) != 0; }
  /// The particle must not be driven.
  void constrain(int id, Vec<double, Dim>& v) const {
    if (!axes) return;
    for (int k = 0; k < Dim; ++k)
      if (axes[id] >> k & 1) v[k] = 0;
  }
};

}  // namespace taut
