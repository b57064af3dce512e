#include "render/cover.hpp"

#include <algorithm>
#include <cmath>

namespace taut::render {
namespace {

constexpr int samples = 2;  // per direction
constexpr int side = 8;     // of a tile, samples
constexpr float nothing = -1e30f;
constexpr float rounding_margin = 0.1f;  // samples; OpenGL rounds differently

struct Span {
  int from, to;
};

Span span_of(float centre, float half, int most) {
  return {std::clamp(static_cast<int>(std::ceil(centre - half - 0.5f)), 0, most),
          std::clamp(static_cast<int>(std::floor(centre + half - 0.5f)) + 1, 0, most)};
}

template <class Visit>
void for_rows(float x, float y, float radius, int width, int height, const Visit& visit) {
  const Span rows = span_of(y, radius, height);
  for (int row = rows.from; row < rows.to; ++row) {
    const float dy = static_cast<float>(row) + 0.5f - y;
    const Span span = span_of(x, std::sqrt(std::max(radius * radius - dy * dy, 0.0f)), width);
    const auto offset = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
    visit(offset + static_cast<std::size_t>(span.from), offset + static_cast<std::size_t>(span.to));
  }
}

}  // namespace

struct Cover::Tiles {
  int left, right, top, bottom;

  Tiles(const Ball& ball, int width, int height) {
    const Span x = span_of(samples * ball.x, samples * ball.radius + rounding_margin, width);
    const Span y = span_of(samples * ball.y, samples * ball.radius + rounding_margin, height);
    left = x.from / side, right = (x.to + side - 1) / side;
    top = y.from / side, bottom = (y.to + side - 1) / side;
  }
};

Cover::Cover(int width, int height)
    : width_(samples * width),
      height_(samples * height),
      tile_columns_((width_ + side - 1) / side),
      tile_rows_((height_ + side - 1) / side) {}

void Cover::clear() {
  depth_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), nothing);
  tile_.assign(static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows_), nothing);
}

bool Cover::hides(const Tiles& tiles, float front) const {
  for (int row = tiles.top; row < tiles.bottom; ++row)
    for (int column = tiles.left; column < tiles.right; ++column)
      if (tile_[static_cast<std::size_t>(row * tile_columns_ + column)] < front) return false;
  return true;
}

bool Cover::hides(const Ball& ball) const {
  const float front = ball.z + ball.radius;
  if (hides(Tiles(ball, width_, height_), front)) return true;
  unsigned seen = 0;
  for_rows(samples * ball.x, samples * ball.y, samples * ball.radius + rounding_margin, width_, height_,
           [&](std::size_t from, std::size_t to) {
             for (; from < to; ++from) seen |= static_cast<unsigned>(depth_[from] < front);
           });
  return seen == 0;
}

void Cover::add(const Ball& ball) {
  for_rows(samples * ball.x, samples * ball.y, samples * ball.radius - rounding_margin, width_, height_,
           [&](std::size_t from, std::size_t to) {
             for (; from < to; ++from) depth_[from] = std::max(depth_[from], ball.z);
           });
  update(Tiles(ball, width_, height_));
}

void Cover::update(const Tiles& tiles) {
  for (int row = tiles.top; row < tiles.bottom; ++row)
    for (int column = tiles.left; column < tiles.right; ++column) {
      float least = 1e30f;
      for (int y = row * side; y < std::min((row + 1) * side, height_); ++y)
        for (int x = column * side; x < std::min((column + 1) * side, width_); ++x)
          least = std::min(least, depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                         static_cast<std::size_t>(x)]);
      tile_[static_cast<std::size_t>(row * tile_columns_ + column)] = least;
    }
}

}  // namespace taut::render
