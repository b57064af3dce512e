#pragma once

#include <memory>

#include "engine/frame_view.hpp"
#include "render/colormap.hpp"
#include "render/image/image.hpp"
#include "render/page/page_layout.hpp"

namespace taut::render {

inline constexpr int least_size = 64;
inline constexpr int greatest_size = 8192;

/// What holds for every frame of a sequence.
struct DrawOptions {
  int width = 1280;  // pixels, least_size to greatest_size
  int height = 720;
  View view;
  double low = 0;  // range of the field, in its unit; values beyond take the colour of the end
  double high = 1;
  const Colormap* colormap = find_colormap("viridis");
  bool bare = false;  // particles only, over the whole picture
  double until = 0;   // s, time of the last frame: all times are shown in its unit; 0 = each in its own
};

/// A value that is not a number is drawn in this colour, which is in none of the maps.
inline constexpr Rgb not_a_number_color = {255, 0, 255};

/// Draws frames into one image, that it keeps.
class Renderer {
 public:
  /// UsageError if an option is out of bounds, OutputError if the font is missing.
  explicit Renderer(const DrawOptions& options);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Valid until the next call. The same frame gives the same bytes. Particles whose position or size is not
  /// finite are left out.
  const Image& draw(const FrameView& frame);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace taut::render
