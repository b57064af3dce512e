#pragma once

#include <string>
#include <vector>

#include "engine/methods/catalogue.hpp"
#include "engine/scene/scene.hpp"
#include "engine/solver/simulation.hpp"

/// Warnings of one sentence each, without a full stop.
namespace taut {

/// Warns of `reaction` and `contact_force` probes if the method does not conserve linear momentum.
std::string warning_about_reactions(const Scene& scene, const MethodInfo& method);

/// Warns of bodies whose mass differs from their shape's, speeds above the sound speed, thin parts, contacts that
/// store energy, and bodies that may join in contact by `sph`.
std::vector<std::string> warnings_at_start(const Scene& scene, const MethodInfo& method,
                                           const Simulation& simulation);

}  // namespace taut
