#pragma once

#include <memory>

#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"
#include "engine/solver/simulation.hpp"

namespace taut {

/// Throws UsageError for invalid settings, SceneError for a scene that cannot run.
std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Settings& settings);

}  // namespace taut
