#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/image/image.hpp"

namespace taut::render {

/// A round particle in a plot.
struct Dot {
  float x, y;           // centre, pixels from the plot's top left corner, downwards
  float radius;         // pixels
  std::uint32_t color;  // bytes R, G, B, 255 in memory
};

/// Draws antialiased discs. The same discs give the same pixels on every machine.
///
/// Where discs overlap, a pixel belongs to the disc whose centre is nearest (in radii): neighbours pressed
/// together meet in a straight line, and the order of the particles shows at most where two rims meet.
///
/// The plot is drawn in bands of rows whose samples stay in the processor's cache, and in tiles of a band:
/// what no disc touches costs nothing.
class DiscPainter {
 public:
  /// Of one plot of one image, that is of the background's colour at first and that nothing else draws into.
  explicit DiscPainter(const Rect& plot, Rgb background = white);

  /// Paints the discs into the plot, in place of those before.
  void draw(Image& image, std::span<const Dot> discs);

 private:
  struct Bands;  // the first and the last
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
  std::uint32_t background_;             // bytes B, G, R, 255 in memory
  int bands_, tiles_;                    // of the plot, downwards and to the right
  std::size_t stride_;                   // from one row of samples to the next
  std::vector<std::uint32_t> end_;       // of each band's discs in `sorted_`, behind the 0 where all begin
  std::vector<std::uint32_t> sorted_;    // numbers of discs, band after band, in the order of the discs
  std::vector<std::uint32_t> color_;     // of a band's samples; bytes B, G, R, 255 in memory
  std::vector<float> depth_;             // of those: what is nearest to a centre is in front, 0 to 1
  std::vector<std::uint8_t> touched_;    // of each tile of the band: a disc reaches into it
  std::vector<std::uint8_t> was_drawn_;  // of each tile of the plot: it is not empty
};

}  // namespace taut::render
