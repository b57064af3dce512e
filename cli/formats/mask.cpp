#include "cli/formats/mask.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include <fmt/core.h>

#include "engine/error.hpp"
#include "engine/scene/contours.hpp"
#include "render/image/png.hpp"

namespace taut::cli {
namespace {

/// Reads the header [PNG §11.2.2].
void check_size(const std::filesystem::path& png) {
  std::array<unsigned char, 24> head{};
  std::ifstream file(png, std::ios::binary);
  file.read(reinterpret_cast<char*>(head.data()), head.size());
  if (!file) return;  // reported by read_png
  const auto side = [&](std::size_t from) {
    return (head[from] * 256L + head[from + 1]) * 65536L + head[from + 2] * 256L + head[from + 3];
  };
  const long columns = side(16), rows = side(20);
  if (std::max(columns, rows) > greatest_mask_side)
    throw UsageError(fmt::format("{} has {} × {} pixels; a mask can have at most {} × {}: make it smaller",
                                 png.string(), columns, rows, greatest_mask_side, greatest_mask_side));
}

}  // namespace

Mask read_mask(const std::filesystem::path& png, MaskOf of) {
  check_size(png);
  const render::Image image = render::read_png(png, render::Alpha::kept);
  Mask mask{image.width, image.height, {}};
  for (std::size_t pixel = 0; pixel < image.pixels.size(); pixel += 4) {
    const float alpha = static_cast<float>(image.pixels[pixel + 3]) / 255;
    const float luminance = (0.0722f * static_cast<float>(image.pixels[pixel]) +
                             0.7152f * static_cast<float>(image.pixels[pixel + 1]) +
                             0.2126f * static_cast<float>(image.pixels[pixel + 2])) /
                            255;
    mask.solid.push_back(of == MaskOf::alpha ? alpha : alpha * (1 - luminance));
  }
  return mask;
}

Mask cropped(const Mask& mask) {
  int left = mask.columns, right = -1, top = mask.rows, bottom = -1;
  for (int row = 0; row < mask.rows; ++row) {
    for (int column = 0; column < mask.columns; ++column) {
      if (!(mask.at(column, row) > 0)) continue;
      left = std::min(left, column), right = std::max(right, column);
      top = std::min(top, row), bottom = std::max(bottom, row);
    }
  }
  Mask part{std::max(0, right - left + 1), std::max(0, bottom - top + 1), {}};
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column) part.solid.push_back(mask.at(column, row));
  return part;
}

std::vector<Chain> faces_of(const Mask& mask, double threshold) {
  const PlaceGrid centres{.low = {0.5, 0.5, 0}, .pitch = 1, .columns = mask.columns, .rows = mask.rows};
  const auto solid = [&](const Point& x) -> double {
    const int column = static_cast<int>(std::floor(x[0])),
              row = mask.rows - 1 - static_cast<int>(std::floor(x[1]));
    return column < 0 || row < 0 || column >= mask.columns || row >= mask.rows ? -1 : mask.at(column, row);
  };
  const auto face = [&](const Point& in, const Point& out) {
    const double from = solid(in), to = solid(out);
    const double share = to < 0 ? 0.5 : (from - threshold) / (from - to);  // outside the picture: at its edge
    return Point{in[0] + share * (out[0] - in[0]), in[1] + share * (out[1] - in[1]), 0};
  };
  const auto inside = [&](long column, long row) { return solid(centres.at(column, row)) > threshold; };
  constexpr double fine = 0.05;  // tolerance, pixels
  std::vector<Chain> faces;
  for (const Chain& chain : contours(centres, inside, face)) {
    Chain face_of = simplified(chain, fine);
    if (face_of.size() >= 3) faces.push_back(std::move(face_of));
  }
  return faces;
}

}  // namespace taut::cli
