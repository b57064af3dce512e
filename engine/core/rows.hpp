#pragma once

#include <cstddef>

#include "engine/core/tensor.hpp"

namespace taut {

/// Row of doubles, padded to packs, aligned to cache lines if it fills them.
constexpr int row_width(int columns) { return (columns + lanes - 1) / lanes * lanes; }
constexpr std::size_t row_alignment(int columns) { return row_width(columns) % (2 * lanes) == 0 ? 64 : 32; }
template <int Width>
struct alignas(row_alignment(Width)) Row {
  static constexpr int width = row_width(Width);
  double c[width] = {};
};

}  // namespace taut
