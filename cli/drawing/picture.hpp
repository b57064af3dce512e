#pragma once

#include <memory>

#include "cli/drawing/frames.hpp"
#include "cli/drawing/look.hpp"
#include "render/renderer.hpp"

namespace taut::cli {

/// A renderer for pictures of a plan whose range and view are known.
std::unique_ptr<render::Renderer> make_renderer(const DrawingPlan& plan, double until);

/// The particles of a snapshot with the values of the plan's field and everything that stands beside them.
struct Picture {
  Picture(const DrawingPlan& plan, const Captions& captions, const Snapshot& snapshot);

  std::vector<double> value;  // in the field's unit
  FrameView view;             // refers to them and to what it was made from
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
};

/// The plan with what it leaves open as it suits this snapshot alone.
DrawingPlan fitted(DrawingPlan plan, const Snapshot& snapshot);

/// One picture, of this moment alone.
render::Image draw_picture(const DrawingPlan& plan, const Captions& captions, const Snapshot& snapshot);

}  // namespace taut::cli
