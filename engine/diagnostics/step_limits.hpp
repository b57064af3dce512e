#pragma once

#include <string_view>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"

namespace taut {

/// What a theory says of the largest stable step.
struct StepLimit {
  std::string_view name, source;
  double step;  // s
};

/// Limits for the method of the settings, of small waves in an unbounded square or cubic lattice of the first
/// body's material with the scene's spacing; none for methods that do not follow from a law on neighbours of
/// the start in one leap-frog step.
///
/// - sharp: Δt = 2/(c_p max |κ(q)|), κ(q) = Σ_j V B W′ e_ij sin(q·X_ij) the gradient that the method has for
///   a plane wave q, over all q of the lattice. With the nearest neighbours only, two along each of d axes, it
///   is (ρ/|m W′|) √(ρ/d(K + 4G/3)).
/// - [Zhang2020] Eq. 15b, of its method in 2D: (ρ/|m W′|) √(ρ (1 − 2ν)/((3 − 4ν) E/(1 + ν))), sufficient
/// where the
///   support holds the four nearest neighbours only. Its G is twice the shear modulus, E/(1 + ν). Where
///   gradients are normalised W′ stands for the normalised one here (the paper does not say).
std::vector<StepLimit> step_limits(const Scene& scene, const Settings& settings);

}  // namespace taut
