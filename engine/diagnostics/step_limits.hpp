#pragma once

#include <string_view>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"

namespace taut {

/// Theoretical limit.
struct StepLimit {
  std::string_view name, source;
  double step;  // s
};

/// Limits for small waves in an unbounded square or cubic lattice of the first body's material. None unless the
/// method is one leap-frog step of a law on initial neighbours.
/// - sharp: Δt = 2/(c_p max |κ(q)|) over plane waves q with gradient κ(q) = Σ_j V B W′ e_ij sin(q·X_ij). With two
///   nearest neighbours per axis in d dimensions: (ρ/|m W′|) √(ρ/d(K + 4G/3)).
/// - [Zhang2020] Eq. 15b, 2D, for normalised gradients: (ρ/|m W′|) √(ρ (1 − 2ν)/((3 − 4ν) E/(1 + ν))), sufficient for
///   four neighbours. Its G is E/(1 + ν), twice the shear modulus. W′ is normalised here; the paper does not say.
std::vector<StepLimit> step_limits(const Scene& scene, const Settings& settings);

}  // namespace taut
