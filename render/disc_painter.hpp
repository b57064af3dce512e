#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/image/image.hpp"

namespace taut::render {

/// A round particle in the plot.
struct Dot {
  float x, y;           // centre, pixels from the plot's top left corner, y downwards
  float radius;         // pixels
  std::uint32_t color;  // bytes R, G, B, 255 in memory
};

/// Draws antialiased discs. The same discs give the same pixels on every machine.
///
/// Where discs overlap, a pixel belongs to the disc with the nearest centre, in radii. Overlapping neighbours thus
/// meet in a straight line, and the particle order matters only where two rims meet.
///
/// Drawing proceeds in bands of rows, whose samples fit into the processor cache, and in tiles of a band. Empty
/// tiles are skipped.
class DiscPainter {
 public:
  /// The plot must have the background's colour, and nothing else may draw into it.
  explicit DiscPainter(const Rect& plot, Rgb background = white);

  /// Draws the discs into the plot, in place of the previous discs.
  void draw(Image& image, std::span<const Dot> discs);

 private:
  struct Bands;  // first and last band of a disc
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
  int bands_, tiles_;                    // number of bands downwards, of tiles to the right
  std::size_t stride_;                   // distance between rows of samples
  std::vector<std::uint32_t> end_;       // end of each band's discs in `sorted_`, after a leading 0
  std::vector<std::uint32_t> sorted_;    // disc numbers by band, in the order of the discs
  std::vector<std::uint32_t> color_;     // samples of a band; bytes B, G, R, 255 in memory
  std::vector<float> depth_;             // per sample: distance to the nearest disc centre, 0 to 1
  std::vector<std::uint8_t> touched_;    // per tile of the band: a disc touches it
  std::vector<std::uint8_t> was_drawn_;  // per tile of the plot: it contains discs
};

}  // namespace taut::render
