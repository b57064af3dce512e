#pragma once

#include <limits>

#include "render/image/image.hpp"

namespace taut::render {

/// Just noticeable difference in colour, ΔE*ab. Rounding on another processor stays well below.
inline constexpr double just_noticeable = 2.3;

/// Differences of two pictures of equal size. The share measures changes all over the picture; the densest window
/// detects a small local change, such as one moved particle.
struct ImageDifference {
  double share = 0;           // of pixels beyond the tolerance, 0 to 1
  double greatest = 0;        // of any pixel, ΔE*ab (black to white is 100)
  double densest = 0;         // share of differing pixels in the worst window of 16 × 16 pixels, 0 to 1
  int column = 0, row = 0;    // top left corner of that window
  int width = 0, height = 0;  // of that window; less than 16 in smaller pictures
};

/// Limits for equal pictures. Rounding can move an edge across a pixel centre; this affects a few pixels, never many
/// side by side.
struct DifferenceLimit {
  double share = 0.002;
  double densest = 0.05;
  double greatest = std::numeric_limits<double>::infinity();  // ΔE*ab
};

/// UsageError if the sizes differ.
ImageDifference compare(const Image& a, const Image& b, double tolerance = just_noticeable);

/// Greatest ratio of a difference to its limit; up to 1, the pictures are alike.
double excess(const ImageDifference& difference, const DifferenceLimit& limit = {});

bool alike(const ImageDifference& difference, const DifferenceLimit& limit = {});

/// `a` in pale gray, with differing pixels from orange (at the tolerance) to dark red and a frame around the densest
/// window. UsageError if the sizes differ.
Image difference_picture(const Image& a, const Image& b, double tolerance = just_noticeable);

}  // namespace taut::render
