#pragma once

#include <memory>

#include "engine/frame_view.hpp"
#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::render {

struct OffScale;

/// Draws frames into one image, which it owns.
class Renderer {
 public:
  /// The look must be complete. All times use the unit of `until`, the time of the last frame in s; 0: each time has
  /// its own unit. UsageError if a setting is out of bounds, OutputError if the font is missing.
  explicit Renderer(const Look& look, double until = 0);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Changes the viewpoint of a 3D scene. `view` must have the size of the look's view.
  void look_from(const Camera& camera, const View& view);

  /// The image is valid until the next call. The same frame gives the same bytes. Particles with a non-finite
  /// position or size are omitted.
  const Image& draw(const FrameView& frame);
  /// Off-scale values visible in the last picture.
  const OffScale& off_scale() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace taut::render
