#pragma once

#include <limits>

#include "render/image/image.hpp"

namespace taut::render {

/// ΔE*ab.
inline constexpr double just_noticeable = 2.3;

struct ImageDifference {
  double share = 0;           // of pixels that differ
  double greatest = 0;        // ΔE*ab
  double densest = 0;         // share in the worst window of 16 × 16 pixels
  int column = 0, row = 0;    // top left of this window
  int width = 0, height = 0;  // of this window, pixels
};

/// The defaults tolerate edges that round-off moves across pixel centres.
struct DifferenceLimit {
  double share = 0.002;
  double densest = 0.05;
  double greatest = std::numeric_limits<double>::infinity();  // ΔE*ab
};

/// Pixels differ if ΔE*ab exceeds `tolerance`. Throws UsageError for different sizes.
ImageDifference compare(const Image& a, const Image& b, double tolerance = just_noticeable);

/// Greatest ratio of a difference to its limit; pictures are alike up to 1.
double excess(const ImageDifference& difference, const DifferenceLimit& limit = {});

bool alike(const ImageDifference& difference, const DifferenceLimit& limit = {});

/// Shows `a` in pale gray, differences from orange to dark red, and a blue frame around the worst window. Throws
/// UsageError for different sizes.
Image difference_picture(const Image& a, const Image& b, double tolerance = just_noticeable);

}  // namespace taut::render
