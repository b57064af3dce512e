#pragma once

#include <span>
#include <vector>

#include "cli/drawing/bounds.hpp"
#include "cli/drawing/drawing.hpp"
#include "engine/diagnostics/cells.hpp"
#include "engine/frame_view.hpp"
#include "engine/snapshot.hpp"

namespace taut::cli {

/// Where the particles of a run come from, in the order of their creation.
struct Origins {
  int dim = 2;
  std::vector<double> x0;        // n × dim, m
  std::vector<double> m;         // mass, kg (per metre depth in 2D)
  std::vector<double> diameter;  // m
  std::vector<int> body;         // index into Scene::bodies

  std::size_t size() const { return m.size(); }
};

Origins origins_of(const Snapshot& snapshot);
/// Of the particles that a run of this scene begins with. Throws SceneError.
Origins origins_of(const Scene& scene);

/// The particles of one picture; the arrays of its view are its own.
struct StagedParticles {
  int dim = 2;
  double time = 0;  // s
  std::vector<double> x{}, diameter{}, value{}, cell{};
  Point origin{};                 // of the picture, in the scene, m
  std::vector<WallFace> walls{};  // about it

  FrameView view() const;
};

/// What a drawing shows of a run's particles: without what is cut away, and about the body that is followed.
///
/// A cut goes by where a particle was at the start: half of a body stays half of it however it moves, and the
/// face of the cut deforms as the body does.
class Staging {
 public:
  /// UsageError for a cut that leaves nothing.
  Staging(const Drawing& drawing, Origins origins);

  int dim() const { return origins_.dim; }
  std::size_t size() const { return shown_.size(); }  // particles that are drawn

  /// `particles` are all of the run.
  StagedParticles operator()(const FrameView& particles) const;
  /// The same as they are drawn: in style `cells` as pieces of their bodies, without those that others
  /// surround.
  StagedParticles dressed(StagedParticles staged) const;
  /// What a view that is open has to hold of such particles, and their values.
  void extend(SequenceBounds& bounds, const StagedParticles& staged) const;

 private:
  void find_cells();
  Point middle(const FrameView& particles) const;

  Origins origins_;
  std::vector<WallFace> walls_;
  std::optional<int> followed_;
  std::vector<std::size_t> shown_;  // numbers of the particles
  std::optional<Cells> cells_;      // of those, if they are to be drawn
};

}  // namespace taut::cli
