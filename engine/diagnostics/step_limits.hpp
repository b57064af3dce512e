#pragma once

#include <string_view>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"

namespace taut {

/// A theoretical limit of the time step.
struct StepLimit {
  std::string_view name, source;
  double step;  // s
};

/// Limits for small waves in an unbounded square or cubic lattice of the first body's material with the scene's
/// spacing; none for methods other than a law on initial neighbours with one leap-frog step.
/// - sharp: Δt = 2/(c_p max |κ(q)|) over all q of the lattice, with the method's gradient of a plane wave κ(q) = Σ_j
///   V B W′ e_ij sin(q·X_ij). With nearest neighbours only, two per axis, it is (ρ/|m W′|) √(ρ/d(K + 4G/3)) in d
///   dimensions.
/// - [Zhang2020] Eq. 15b, for its method in 2D: (ρ/|m W′|) √(ρ (1 − 2ν)/((3 − 4ν) E/(1 + ν))), sufficient if only the
///   four nearest neighbours are in the support. Its G is twice the shear modulus, E/(1 + ν). Here W′ is normalised
///   if gradients are; the paper does not specify this.
std::vector<StepLimit> step_limits(const Scene& scene, const Settings& settings);

}  // namespace taut
