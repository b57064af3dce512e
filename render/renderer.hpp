#pragma once

#include <memory>
#include <set>
#include <string>

#include "engine/frame_view.hpp"
#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::render {

struct OffScale;

class Renderer {
 public:
  /// The look must be complete. `until` (last time, s) sets the unit of all times; if 0, each time has its own unit.
  /// Throws UsageError for values out of bounds, OutputError without the font.
  explicit Renderer(const Look& look, double until = 0);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// `view` must have the size of the look's view.
  void look_from(const Camera& camera, const View& view);

  /// The image is valid until the next call. Equal frames give equal bytes. Omits particles whose
  /// position is not finite.
  const Image& draw(const FrameView& frame);
  const OffScale& off_scale() const;
  /// Texts that did not fit into the drawn pictures.
  std::set<std::string> cut_texts() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace taut::render
