#pragma once

#include <string>
#include <vector>

#include "engine/methods/catalogue.hpp"
#include "engine/scene/scene.hpp"
#include "engine/solver/simulation.hpp"

/// Warnings of one sentence each, without a full stop.
namespace taut {

/// Warns of force probes if the method or its constants do not conserve linear momentum; otherwise returns "".
std::string warning_about_reactions(const Scene& scene, const MethodInfo& method, const Settings& settings);

std::vector<std::string> warnings_at_start(const Scene& scene, const MethodInfo& method,
                                           const Simulation& simulation);

}  // namespace taut
