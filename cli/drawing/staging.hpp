#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "cli/drawing/bounds.hpp"
#include "cli/drawing/drawing.hpp"
#include "cli/drawing/origins.hpp"
#include "cli/drawing/surface.hpp"
#include "engine/diagnostics/cells.hpp"
#include "engine/frame_view.hpp"
#include "engine/snapshot.hpp"

namespace taut::cli {

/// `view` refers to these particles.
struct StagedParticles {
  int dim = 2;
  double time = 0;  // s
  std::vector<double> x{}, diameter{}, value{}, cell{};
  std::vector<std::uint32_t> triangle{};
  std::vector<double> outline{}, undeformed{};  // 2D segments, m
  Point origin{};                               // the picture's origin in scene coordinates, m
  std::vector<WallFace> walls{};

  FrameView view() const;
};

/// Selects and places the particles of a picture.
class Staging {
 public:
  /// Throws UsageError if all particles are hidden.
  Staging(const Drawing& drawing, Origins origins);

  int dim() const { return origins_.dim; }
  std::size_t size() const { return shown_.size(); }

  /// Requires all particles of the run.
  StagedParticles operator()(const FrameView& particles) const;
  /// Adds walls and outlines; applies styles `cells` and `surface`.
  StagedParticles completed(StagedParticles staged) const;
  /// Adds the values, and the positions for an automatic view. Adds initial positions if they are outlined.
  void extend(SequenceBounds& bounds, const StagedParticles& staged) const;

 private:
  struct LazySurface {
    std::shared_ptr<const Scene> scene;
    Expression is_cut;
    std::once_flag made{};
    std::optional<Surface> surface{};
  };

  void find_in_view();
  void find_cells();
  const Surface& surface() const;
  bool draws(Outlines outline) const { return outline_ == outline || outline_ == Outlines::both; }
  StagedParticles with_surface(StagedParticles staged) const;
  Point middle(const FrameView& particles) const;

  Origins origins_;
  std::vector<WallFace> walls_;
  std::optional<int> followed_;
  std::vector<std::size_t> shown_;
  std::vector<std::size_t> in_view_;  // indices into `shown_`; determine an automatic view
  std::optional<Cells> cells_;
  std::shared_ptr<LazySurface> surface_;
  bool draws_surface_, has_categories_;
  Outlines outline_;
};

}  // namespace taut::cli
