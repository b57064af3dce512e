#pragma once

#include "engine/core/point.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Sums over all particles, of the state that `Snapshot` shows.
struct Balance {
  double kinetic = 0, strain = 0;  // J (per metre depth in 2D); strain with that of contacts
  Point linear_momentum{};         // kg m/s
  Point angular_momentum{};        // about the origin, kg m²/s; in 2D only the last component
  double momentum_scale = 0;       // Σ |m v|
  double angular_scale = 0;        // Σ m |x| |v|
  double work = 0;    // done so far by what drives, loads and pulls the bodies, J (per metre depth in 2D)
  double damped = 0;  // taken so far by the scene's damping, J (per metre depth in 2D)
  Impulse of_walls;   // so far: momenta less these are kept
};

Balance balance(const Snapshot& now, const Scene& scene);

/// m c² times 1e-16, of speeds of 1e-8 sound speeds, J: more than what rounding makes of bodies without any.
double energy_of_rounding(const Scene& scene, const Snapshot& start);

}  // namespace taut
