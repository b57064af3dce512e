#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/scene/shape.hpp"

namespace taut::cli {

/// Solid share of each pixel, 0 to 1, row by row from the top.
struct Mask {
  int columns = 0, rows = 0;
  std::vector<float> solid;

  float at(int column, int row) const {
    return solid[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)];
  }
};

inline constexpr int greatest_mask_side = 4096;  // pixels

/// Solid is darkness on a white background, or opacity.
enum class MaskOf : std::uint8_t { darkness, alpha };
/// Throws UsageError if the file is unreadable or too large.
Mask read_mask(const std::filesystem::path& png, MaskOf of);

/// Painted area of an SVG file, about `rows` pixels high, or less if the canvas would exceed greatest_mask_side.
/// Throws UsageError if rsvg-convert is missing or fails, or paints nothing.
Mask paint_svg(const std::filesystem::path& svg, int rows);

Mask cropped(const Mask& mask);

/// Closed contours of a solid share above `threshold`, in pixels from the lower left corner, y up, solid to the left.
std::vector<Chain> faces_of(const Mask& mask, double threshold);

}  // namespace taut::cli
