#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/image/image.hpp"

namespace taut::render {

struct Dot {
  float x, y;           // from the plot's top left, y downwards
  float radius;         // pixels
  std::uint32_t color;  // bytes R, G, B, 255
};

/// Antialiased discs, the same pixels on every machine. A sample shows the disc with the nearest centre, measured in
/// radii of that disc; discs that cover the sample only partly are behind.
class DiscPainter {
 public:
  /// Before the first `draw`, the plot must be filled with `background`, or transparent. Nothing else may draw into it.
  explicit DiscPainter(const Rect& plot, Rgb background = white, bool transparent = false);

  /// Replaces the previous discs.
  void draw(Image& image, std::span<const Dot> discs);

 private:
  struct Bands;
  Bands bands_of(const Dot& disc) const;
  void sort_into_bands(std::span<const Dot> discs);
  std::span<const std::uint32_t> discs_of(int band) const;
  void touch_tiles(const Dot& disc);
  void clear_touched();
  void draw_disc(const Dot& disc, int band);
  void resolve(Image& image, int band);
  void resolve_tile(Image& image, int band, int tile) const;
  std::size_t sample(int column, int row) const { return static_cast<std::size_t>(row) * stride_ + column; }

  Rect plot_;
  std::uint32_t background_;  // bytes B, G, R, 255, or 0
  int bands_, tiles_;
  std::size_t stride_;
  std::vector<std::uint32_t> end_;  // 0, then each band's end in `sorted_`
  std::vector<std::uint32_t> sorted_;
  std::vector<std::uint32_t> color_;  // samples of a band; bytes B, G, R, opacity
  // [sample] below 0.5 inside a disc, 0.5 to 1 on its rim, 1 without a disc
  std::vector<float> depth_;
  std::vector<std::uint8_t> touched_;  // tiles of the band
  std::vector<std::uint8_t> was_drawn_;
};

}  // namespace taut::render
