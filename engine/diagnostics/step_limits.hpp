#pragma once

#include <string_view>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"

namespace taut {

struct StepLimit {
  std::string_view name, source;
  double step;  // s
};

/// Theoretical limits of the time step for small waves in an unbounded lattice of the first body's material. Empty for
/// methods outside the family tl_displacement and for methods with a pair force.
/// - sharp: Δt = 2/(c_p max |κ(q)|) over plane waves q with gradient κ(q) = Σ_j V B W′ e_ij sin(q·X_ij).
/// - sufficient with four neighbours: [Zhang2020] Eq. 15b, whose G is twice the shear modulus. Departure: W′ is divided
///   by S of gradient_correction; the paper does not specify this.
std::vector<StepLimit> step_limits(const Scene& scene, const Settings& settings);

}  // namespace taut
