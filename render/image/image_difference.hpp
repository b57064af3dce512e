#pragma once

#include <limits>

#include "render/image/image.hpp"

namespace taut::render {

/// ΔE*ab; other processors' rounding stays well below.
inline constexpr double just_noticeable = 2.3;

/// Differences of pictures: the share measures widespread ones, the densest window local ones, such as one particle.
struct ImageDifference {
  double share = 0;           // of pixels beyond the tolerance, 0 to 1
  double greatest = 0;        // ΔE*ab
  double densest = 0;         // share in the worst window of 16 × 16 pixels
  int column = 0, row = 0;    // top left of that window
  int width = 0, height = 0;  // of that window; smaller in small pictures
};

/// Limits for equal pictures. Rounding may move edges across pixel centres, but rarely side by side.
struct DifferenceLimit {
  double share = 0.002;
  double densest = 0.05;
  double greatest = std::numeric_limits<double>::infinity();  // ΔE*ab
};

/// Throws UsageError for different sizes.
ImageDifference compare(const Image& a, const Image& b, double tolerance = just_noticeable);

/// Greatest ratio to a limit; alike up to 1.
double excess(const ImageDifference& difference, const DifferenceLimit& limit = {});

bool alike(const ImageDifference& difference, const DifferenceLimit& limit = {});

/// Shows `a` in pale gray, differences from orange (at the tolerance) to dark red, and a frame around the densest
/// window. Throws UsageError for different sizes.
Image difference_picture(const Image& a, const Image& b, double tolerance = just_noticeable);

}  // namespace taut::render
