#pragma once

#include <vector>

#include "engine/layout/element_mesh.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// Particles of all bodies, body after body.
struct InitialParticles {
  int dim = 2;
  std::vector<Point> x, v;     // reference position, m; velocity, m/s
  std::vector<Point> middle;   // position before jitter, m; empty = x
  std::vector<Point> start;    // m; empty = x
  std::vector<double> V0;      // m^dim
  std::vector<double> inside;  // V0 over the volume of a whole cell
  std::vector<int> body;
  std::vector<int> material;
  std::vector<int> drive;
  std::vector<unsigned char> clamped;
  std::vector<unsigned char> guided;  // bit k: fixed along axis k; empty = none
  // index of the image under a symmetry rotation
  std::vector<int> turned;
  std::vector<int> first;     // [body] first particle; then the number of particles
  std::vector<bool> relaxed;  // [body] moved off the lattice to follow the faces; empty = none
  ElementMesh mesh;           // if Scene::element_order > 0: the particles are its nodes

  int size() const { return static_cast<int>(x.size()); }
  std::vector<unsigned char> driven() const {
    std::vector<unsigned char> all;
    for (const int of : drive) all.push_back(of >= 0);
    return all;
  }
  const Point& cell(int i) const { return middle.empty() ? x[i] : middle[i]; }
  const Point& at_start(int i) const { return start.empty() ? x[i] : start[i]; }
};

inline constexpr double greatest_particle_number = 20e6;

/// In a box with particles on its faces, the n + 1 particles along n cells represent ½ − δ, 1 + δ, 1 … cells, as in
/// Gregory's rule. Planes of symmetry keep half cells. Throws SceneError for no or too many particles, overlapping
/// bodies, and regions, loads or cut-outs in conflict or without particles.
InitialParticles make_initial_particles(const Scene& scene);

/// Lattice about the anchor of the first shape. Requires an unplaced body.
std::vector<InitialSite> lattice_sites(const Body& body, int dim, double dp);

}  // namespace taut
