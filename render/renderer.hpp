#pragma once

#include <memory>

#include "engine/frame_view.hpp"
#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::render {

struct OffScale;

/// Draws frames into one image, that it keeps.
class Renderer {
 public:
  /// Nothing of the look may be open. `until` is the time of the last frame, s: all times are shown in its
  /// unit; 0: each in its own. UsageError if something is out of bounds, OutputError if the font is missing.
  explicit Renderer(const Look& look, double until = 0);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// From now on a scene in 3D is seen from elsewhere; the view is of the size that the look has.
  void look_from(const Camera& camera, const View& view);

  /// Valid until the next call. The same frame gives the same bytes. Particles whose position or size is not
  /// finite are left out.
  const Image& draw(const FrameView& frame);
  /// What the picture that was drawn last shows beyond its range, or of no number.
  const OffScale& off_scale() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace taut::render
