#include "render/disc_painter.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace taut::render {
namespace {

constexpr int samples = 2;      // per direction
constexpr int band_height = 8;  // pixels
constexpr int tile_width = 16;  // pixels
constexpr int lanes = 4;

using Floats = float __attribute__((vector_size(4 * lanes)));
using Ints = std::int32_t __attribute__((vector_size(4 * lanes)));
using Colors = std::uint32_t __attribute__((vector_size(4 * lanes)));
using Words = std::uint16_t __attribute__((vector_size(4 * lanes)));

template <class Vector>
Vector loaded(const void* from) {
  Vector vector;
  std::memcpy(&vector, from, sizeof vector);
  return vector;
}

Colors blended(const Colors& over, const Colors& under, const Ints& alpha) {
  const Ints of256 = alpha + (alpha >> 7);
  const Words a = reinterpret_cast<Words>(of256 | of256 << 16), b = 256 - a;
  const Words above = reinterpret_cast<Words>(over), below = reinterpret_cast<Words>(under);
  const Words even = ((above & 255) * a + (below & 255) * b + 128) >> 8;
  const Words odd = (above >> 8) * a + (below >> 8) * b + 128;
  return reinterpret_cast<Colors>(even | (odd & 0xff00));
}

/// Lengths in samples.
struct DiscRow {
  float dy2;  // squared distance from the centre
  float reach;
  float depth;  // per distance from the centre
  std::uint32_t color;
};

void paint(const DiscRow& row, float x, float* depth, std::uint32_t* color) {
  const Floats dx = x + Floats{0, 1, 2, 3};
  const Floats r2 = dx * dx + row.dy2;
  Floats r{};
  for (int k = 0; k < lanes; ++k) r[k] = std::sqrt(r2[k]);
  const Floats coverage = row.reach - r;
  const auto rim = coverage < 1;
  const Floats d = r * row.depth + (rim ? Floats{} + 0.5f : Floats{});
  const auto nearest = loaded<Floats>(depth);
  const auto under = loaded<Colors>(color);
  const auto wins = (coverage > 0) & (d < nearest);
  const Ints alpha = __builtin_convertvector((rim ? coverage : Floats{} + 1) * 255.0f + 0.5f, Ints);
  const Floats new_depth = wins ? d : nearest;
  const Colors new_color = wins ? blended(Colors{} + row.color, under, alpha) : under;
  std::memcpy(depth, &new_depth, sizeof new_depth);
  std::memcpy(color, &new_color, sizeof new_color);
}

std::uint32_t mean(std::uint32_t p, std::uint32_t q) {
  constexpr std::uint32_t even = 0x00ff00ff, halves = 0x00010001;
  return ((((p & even) + (q & even) + halves) >> 1) & even) |
         (((((p >> 8) & even) + ((q >> 8) & even) + halves) >> 1) & even) << 8;
}

struct Span {
  int from, to;
};

Span span_of(float centre, float half, int most) {
  const auto bound = [most](float at) {
    return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(most)));
  };
  return {bound(centre - half + 0.5f), bound(centre + half + 0.5f)};
}

std::uint32_t packed(Rgb color) {
  return std::bit_cast<std::uint32_t>(std::array<std::uint8_t, 4>{color[0], color[1], color[2], 255});
}

std::uint32_t with_blue_first(std::uint32_t color) {
  return (color & 0xff00ff00) | (color & 0xff) << 16 | (color >> 16 & 0xff);
}

int parts(int length, int of) { return (length + of - 1) / of; }

}  // namespace

struct DiscPainter::Bands {
  int first, last;
};

DiscPainter::DiscPainter(const Rect& plot, Rgb background, bool transparent)
    : plot_(plot),
      background_(transparent ? 0 : with_blue_first(packed(background))),
      bands_(parts(plot.height, band_height)),
      tiles_(parts(plot.width, tile_width)),
      stride_(static_cast<std::size_t>(tiles_) * tile_width * samples),
      color_(stride_ * band_height * samples + lanes),  // room for the last vector
      depth_(color_.size()),
      touched_(static_cast<std::size_t>(tiles_)),
      was_drawn_(touched_.size() * static_cast<std::size_t>(bands_)) {}

DiscPainter::Bands DiscPainter::bands_of(const Dot& disc) const {
  const auto band = [&](float y) {
    return static_cast<int>(std::clamp(y, 0.0f, static_cast<float>(plot_.height - 1))) / band_height;
  };
  return {band(disc.y - disc.radius - 1), band(disc.y + disc.radius + 1)};
}

void DiscPainter::sort_into_bands(std::span<const Dot> discs) {
  // counting sort: `end_[band + 1]` is first the band's start; filling `sorted_` advances it to the end
  end_.assign(static_cast<std::size_t>(bands_) + 2, 0);
  for (const Dot& disc : discs)
    for (auto [band, last] = bands_of(disc); band <= last; ++band) ++end_[static_cast<std::size_t>(band) + 2];
  for (std::size_t k = 2; k < end_.size(); ++k) end_[k] += end_[k - 1];
  sorted_.resize(end_.back());
  for (std::uint32_t i = 0; i < discs.size(); ++i)
    for (auto [band, last] = bands_of(discs[i]); band <= last; ++band)
      sorted_[end_[static_cast<std::size_t>(band) + 1]++] = i;
}

std::span<const std::uint32_t> DiscPainter::discs_of(int band) const {
  const std::uint32_t* end = &end_[static_cast<std::size_t>(band)];
  return std::span(sorted_).subspan(end[0], end[1] - end[0]);
}

void DiscPainter::touch_tiles(const Dot& disc) {
  const auto tile = [&](float x) {
    return static_cast<int>(std::clamp(x, 0.0f, static_cast<float>(plot_.width - 1))) / tile_width;
  };
  const float reach = disc.radius + 1;
  for (int k = tile(disc.x - reach), last = tile(disc.x + reach + lanes / samples); k <= last; ++k)
    touched_[static_cast<std::size_t>(k)] = true;
}

void DiscPainter::clear_touched() {
  constexpr int width = samples * tile_width;
  for (int tile = 0; tile < tiles_; ++tile) {
    if (!touched_[static_cast<std::size_t>(tile)]) continue;
    for (int row = 0; row < samples * band_height; ++row) {
      std::fill_n(&color_[sample(tile * width, row)], width, background_);
      std::fill_n(&depth_[sample(tile * width, row)], width, 1.0f);
    }
  }
}

void DiscPainter::draw_disc(const Dot& disc, int band) {
  const float x = samples * disc.x, y = samples * (disc.y - static_cast<float>(band * band_height));
  const float radius = samples * disc.radius;
  DiscRow row{0, radius + 0.5f, 0.5f / (radius + 1), with_blue_first(disc.color)};
  const auto [top, bottom] = span_of(y, row.reach, samples * band_height);
  for (int j = top; j < bottom; ++j) {
    const float dy = static_cast<float>(j) + 0.5f - y;
    row.dy2 = dy * dy;
    const float half = std::sqrt(std::max(row.reach * row.reach - row.dy2, 0.0f));
    const auto [left, right] = span_of(x, half, samples * plot_.width);
    for (int i = left; i < right; i += lanes)
      paint(row, static_cast<float>(i) + 0.5f - x, &depth_[sample(i, j)], &color_[sample(i, j)]);
  }
}

void DiscPainter::resolve_tile(Image& image, int band, int tile) const {
  const int left = tile * tile_width, top = band * band_height;
  const auto bytes = static_cast<std::size_t>(std::min(tile_width, plot_.width - left)) * 4;
  std::array<std::uint32_t, tile_width> pixels;
  pixels.fill(background_);
  for (int row = 0; row < std::min(band_height, plot_.height - top); ++row) {
    if (touched_[static_cast<std::size_t>(tile)]) {
      const std::uint32_t* above = &color_[sample(samples * left, samples * row)];
      const std::uint32_t* below = above + stride_;
      for (std::size_t k = 0; k < tile_width; ++k)
        pixels[k] = mean(mean(above[2 * k], above[2 * k + 1]), mean(below[2 * k], below[2 * k + 1]));
    }
    std::memcpy(&image.pixels[image.offset(plot_.x + left, plot_.y + top + row)], pixels.data(), bytes);
  }
}

void DiscPainter::resolve(Image& image, int band) {
  for (int tile = 0; tile < tiles_; ++tile) {
    std::uint8_t& was_drawn = was_drawn_[static_cast<std::size_t>(band * tiles_ + tile)];
    const std::uint8_t touched = touched_[static_cast<std::size_t>(tile)];
    if (touched || was_drawn) resolve_tile(image, band, tile);
    was_drawn = touched;
  }
}

void DiscPainter::draw(Image& image, std::span<const Dot> discs) {
  sort_into_bands(discs);
  for (int band = 0; band < bands_; ++band) {
    std::ranges::fill(touched_, std::uint8_t{0});
    for (const std::uint32_t i : discs_of(band)) touch_tiles(discs[i]);
    clear_touched();
    for (const std::uint32_t i : discs_of(band)) draw_disc(discs[i], band);
    resolve(image, band);
  }
}

}  // namespace taut::render
