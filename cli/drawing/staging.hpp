#pragma once

#include <span>
#include <vector>

#include "cli/drawing/bounds.hpp"
#include "cli/drawing/drawing.hpp"
#include "engine/diagnostics/cells.hpp"
#include "engine/frame_view.hpp"
#include "engine/snapshot.hpp"

namespace taut::cli {

/// Initial particles, in the order of creation.
struct Origins {
  int dim = 2;
  std::vector<double> x0;        // n × dim, m
  std::vector<double> m;         // kg, in 2D per metre of depth
  std::vector<double> diameter;  // m
  std::vector<int> body;         // index into Scene::bodies

  std::size_t size() const { return m.size(); }
};

Origins origins_of(const Snapshot& snapshot);
/// Throws SceneError.
Origins origins_of(const Scene& scene);

/// Particles of one picture; `view` refers to them.
struct StagedParticles {
  int dim = 2;
  double time = 0;  // s
  std::vector<double> x{}, diameter{}, value{}, cell{};
  Point origin{};                 // m, in the scene
  std::vector<WallFace> walls{};  // relative to `origin`

  FrameView view() const;
};

/// Selects and places the particles of a picture. The cut uses initial positions, so it deforms with the body.
class Staging {
 public:
  /// Throws UsageError if the cut leaves no particle.
  Staging(const Drawing& drawing, Origins origins);

  int dim() const { return origins_.dim; }
  std::size_t size() const { return shown_.size(); }

  /// Requires all particles of the run.
  StagedParticles operator()(const FrameView& particles) const;
  /// Adds walls; style `cells` replaces particles by visible cells.
  StagedParticles with_cells_and_walls(StagedParticles staged) const;
  void extend(SequenceBounds& bounds, const StagedParticles& staged) const;

 private:
  void find_cells();
  Point middle(const FrameView& particles) const;

  Origins origins_;
  std::vector<WallFace> walls_;
  std::optional<int> followed_;
  std::vector<std::size_t> shown_;  // particle numbers
  std::optional<Cells> cells_;
};

}  // namespace taut::cli
