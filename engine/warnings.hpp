#pragma once

#include <string>
#include <vector>

#include "engine/methods/catalogue.hpp"
#include "engine/scene/scene.hpp"
#include "engine/solver/simulation.hpp"

/// Warnings about scenes that run and are probably not what their author wants; one sentence each, without a full stop.
namespace taut {

/// `reaction` probes of a method that does not conserve momentum; empty if there are none.
std::string warning_about_reactions(const Scene& scene, const MethodInfo& method);

/// Warnings about the initial state of a simulation of `scene` with `method`: masses that differ from the shapes by 2 %
/// or more, speeds above the sound speed, contacts that store energy, bodies that `sph` may join.
std::vector<std::string> warnings_at_start(const Scene& scene, const MethodInfo& method,
                                           const Simulation& simulation);

}  // namespace taut
