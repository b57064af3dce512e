#pragma once

#include <limits>

#include "render/image/image.hpp"

namespace taut::render {

/// Colour difference (ΔE*ab) that is just noticeable. Differences by rounding on other processors are much smaller.
inline constexpr double just_noticeable = 2.3;

/// Difference of two pictures of one size. The share measures widespread changes. The densest window measures local
/// changes, such as one moved particle, which hardly affect the share.
struct ImageDifference {
  double share = 0;           // of pixels beyond the tolerance, 0 to 1
  double greatest = 0;        // ΔE*ab
  double densest = 0;         // share of differing pixels in the worst window of 16 × 16 pixels, 0 to 1
  int column = 0, row = 0;    // top left of that window
  int width = 0, height = 0;  // of that window; smaller in small pictures
};

/// Limits for equal pictures. Rounding may move edges across pixel centres, but rarely at many adjacent pixels.
struct DifferenceLimit {
  double share = 0.002;
  double densest = 0.05;
  double greatest = std::numeric_limits<double>::infinity();  // ΔE*ab
};

/// Throws UsageError for pictures of different sizes.
ImageDifference compare(const Image& a, const Image& b, double tolerance = just_noticeable);

/// Greatest ratio of a difference to its limit; pictures are alike up to 1.
double excess(const ImageDifference& difference, const DifferenceLimit& limit = {});

bool alike(const ImageDifference& difference, const DifferenceLimit& limit = {});

/// Shows `a` in pale gray, differences from orange (at the tolerance) to dark red, and a frame around the densest
/// window. Throws UsageError for different sizes.
Image difference_picture(const Image& a, const Image& b, double tolerance = just_noticeable);

}  // namespace taut::render
