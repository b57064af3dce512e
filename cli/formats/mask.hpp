#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/scene/shape.hpp"

namespace taut::cli {

/// How much of each pixel of a picture is solid, from 0 to 1, row after row from the top.
struct Mask {
  int columns = 0, rows = 0;
  std::vector<float> solid;

  float at(int column, int row) const {
    return solid[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)];
  }
};

inline constexpr int greatest_mask_side = 4096;  // pixels

/// The darkness of a PNG file over white; with `alpha` how opaque it is. UsageError if it cannot be read, or
/// has more pixels than a mask may.
enum class MaskOf : std::uint8_t { darkness, alpha };
Mask read_mask(const std::filesystem::path& png, MaskOf of);

/// What an SVG file paints, by librsvg: where its paths are, filled by their rules or stroked, whatever their
/// colour. `rows` pixels from the lowest to the highest point that is painted, or fewer, where more would
/// make the picture too large. UsageError if it cannot be read, or paints nothing.
Mask paint_svg(const std::filesystem::path& svg, int rows);

/// The part of it that is solid at all.
Mask cropped(const Mask& mask);

/// The faces of what is solid by more than `threshold`, between pixels linearly interpolated: closed chains
/// in pixels from the lower left corner, y up, with the solid to the left.
std::vector<Chain> faces_of(const Mask& mask, double threshold);

}  // namespace taut::cli
