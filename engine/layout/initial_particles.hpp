#pragma once

#include <vector>

#include "engine/scene/scene.hpp"

namespace taut {

/// The particles of a scene at t = 0, body after body.
struct InitialParticles {
  int dim = 2;
  std::vector<Point> x, v;  // in the reference configuration, m; m/s
  std::vector<Point>
      middle;                // of their cells, m, which regions and images are told by; empty where that is x
  std::vector<Point> start;  // where each starts, m; empty where that is x for all
  std::vector<double> V0;    // m^dim
  std::vector<double> inside;  // V0 over its cell: less than 1 on a face, a little more behind a free one
  std::vector<int> body;       // index into Scene::bodies
  std::vector<int> material;   // index into Scene::materials
  std::vector<int> drive;      // index into the body's drives, or -1
  std::vector<unsigned char> held;    // 1: stays where it is
  std::vector<unsigned char> guided;  // bit k: does not move along axis k; empty where all are free or held
  std::vector<int> turned;            // where a turn of the body that maps its layout onto itself takes each:
                                      // another particle of the body, or itself where there is no such turn
  std::vector<int> first;             // first particle of each body, and one past the last of all

  int size() const { return static_cast<int>(x.size()); }
  /// 1: moved by the scene up to some time.
  std::vector<unsigned char> driven() const {
    std::vector<unsigned char> all;
    for (const int of : drive) all.push_back(of >= 0);
    return all;
  }
  const Point& cell(int i) const { return middle.empty() ? x[i] : middle[i]; }
  const Point& at_start(int i) const { return start.empty() ? x[i] : start[i]; }
};

inline constexpr double greatest_particle_number = 20e6;

/// Bodies are filled with a square (cubic) lattice; discs and rings of another layout that are a whole body
/// with concentric layers (RoundLayout) whose particles share the layer's area, so that their mass is exact;
/// a box whose particles stand on its faces with a lattice whose outermost particles have parts of a cell:
/// along an axis of n cells ½ − δ, 1 + δ, 1 … of one, δ = n/(12 (n − 1)), which integrates polynomials of
/// degree 2 exactly (Simpson's rule for n = 2 and 3, Gregory's for many). So mass, moments of inertia and the
/// resistance to bending are the body's; with halves all would be too great by 2/n². A face that slides along
/// itself or is held in all but its normal may be a plane of symmetry: there it is the half cell, as it must
/// be in a body and its image. Then they are jittered (volumes stay), reflected, rotated, and displaced to where
/// they start. Throws SceneError: no particles, too many, bodies that overlap.
InitialParticles make_initial_particles(const Scene& scene);

}  // namespace taut
