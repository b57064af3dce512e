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
/// Throws UsageError.
Mask read_mask(const std::filesystem::path& png, MaskOf of);

/// Painted area of an SVG file, up to about `rows` pixels high. Throws UsageError.
Mask paint_svg(const std::filesystem::path& svg, int rows);

Mask cropped(const Mask& mask);

/// Closed contours in pixels from the lower left corner, y up. The solid share exceeds `threshold` on their left.
std::vector<Chain> faces_of(const Mask& mask, double threshold);

}  // namespace taut::cli
