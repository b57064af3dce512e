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

/// Largest stable time steps in theory, s, for small waves in an unbounded lattice of the first body's material.
/// Empty for methods outside the family tl_displacement and for methods with a pair force.
/// - sharp: Δt = 2/(c_p max |κ(q)|) over plane waves q with gradient κ(q) = Σ_j V B W′ e_ij sin(q·X_ij).
/// - [Zhang2020] Eq. 15b, in 2D with normalised gradients: (ρ/|m W′|) √(ρ (1 − 2ν)/((3 − 4ν) E/(1 + ν))). The G of the
///   paper is twice the shear modulus. Here W′ is normalised; the paper does not specify this.
std::vector<StepLimit> step_limits(const Scene& scene, const Settings& settings);

}  // namespace taut
