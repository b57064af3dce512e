#pragma once

#include <vector>

#include "engine/scene/scene.hpp"

namespace taut {

/// The particles of a scene at t = 0, body after body.
struct InitialParticles {
  int dim = 2;
  std::vector<Point> x, v;            // m, m/s
  std::vector<double> V0;             // m^dim
  std::vector<int> body;              // index into Scene::bodies
  std::vector<int> material;          // index into Scene::materials
  std::vector<int> drive;             // index into the body's drives, or -1
  std::vector<unsigned char> held;    // 1: stays where it is
  std::vector<unsigned char> guided;  // bit k: does not move along axis k; empty where all are free or held
  std::vector<int> turned;            // where a turn of the body that maps its layout onto itself takes each:
                                      // another particle of the body, or itself where there is no such turn
  std::vector<int> first;             // first particle of each body, and one past the last of all

  int size() const { return static_cast<int>(x.size()); }
};

inline constexpr double greatest_particle_number = 20e6;

/// Boxes, unions and round shapes of layout `lattice` are filled with a square lattice, other discs and rings
/// that are a body with concentric layers (RoundLayout) whose particles share the layer's area, so that their
/// mass is exact. Throws SceneError: no particles, too many, bodies that overlap.
InitialParticles make_initial_particles(const Scene& scene);

}  // namespace taut
