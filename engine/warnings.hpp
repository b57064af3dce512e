#pragma once

#include <string>
#include <vector>

#include "engine/methods/catalogue.hpp"
#include "engine/scene/scene.hpp"
#include "engine/solver/simulation.hpp"

/// Warnings about scenes that run but are probably wrong; one sentence each, without a full stop.
namespace taut {

/// Warns of `reaction` probes if the method does not conserve momentum; else empty.
std::string warning_about_reactions(const Scene& scene, const MethodInfo& method);

/// Warns of masses 2 % or more off the shapes, supersonic speeds, contacts that store energy, bodies that `sph` may
/// join.
std::vector<std::string> warnings_at_start(const Scene& scene, const MethodInfo& method,
                                           const Simulation& simulation);

}  // namespace taut
