#include "cli/drawing/origins.hpp"

#include <cmath>

#include "engine/layout/initial_particles.hpp"

namespace taut::cli {

Origins origins_of(const Snapshot& snapshot) {
  return {snapshot.dim, snapshot.x0, snapshot.m, snapshot.diameter, snapshot.body};
}

Origins origins_of(const Scene& scene) {
  const InitialParticles particles = make_initial_particles(scene);
  Origins origins{scene.dim, {}, {}, {}, particles.body};
  for (std::size_t i = 0; i < particles.V0.size(); ++i) {
    const Point& x = particles.x[i];
    origins.x0.insert(origins.x0.end(), x.begin(), x.begin() + scene.dim);
    const auto material = static_cast<std::size_t>(particles.material[i]);
    origins.diameter.push_back(std::pow(particles.V0[i], 1.0 / scene.dim));
    origins.m.push_back(scene.materials[material].density * particles.V0[i]);
  }
  return origins;
}

}  // namespace taut::cli
