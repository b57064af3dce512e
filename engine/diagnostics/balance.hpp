#pragma once

#include "engine/core/point.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

struct Balance {
  double kinetic = 0, strain = 0;  // J; `strain` includes contact
  Point linear_momentum{};         // kg m/s
  Point angular_momentum{};        // about the origin, kg m²/s; in 2D only z
  double momentum_scale = 0;       // Σ |m v|, kg m/s
  double angular_scale = 0;        // Σ m |x| |v|, kg m²/s
  double work = 0;                 // of drives, loads and gravity so far, J
  double damped = 0;               // J
  Impulse of_walls;                // so far
};

Balance balance(const Snapshot& now, const Scene& scene);

/// Σ m (1e-8 c0)² with the greatest c0, J.
double energy_of_rounding(const Scene& scene, const Snapshot& start);

}  // namespace taut
