#pragma once

#include <limits>

#include "render/image/image.hpp"

namespace taut::render {

/// A difference in colour (ΔE*ab) that an eye just notices; rounding on another processor stays well below
/// it.
inline constexpr double just_noticeable = 2.3;

/// How two pictures of one size differ. The share tells of a change spread over the picture, the densest
/// window of a small change in one place (one particle moved), which the share alone would hide.
struct ImageDifference {
  double share = 0;           // of pixels that differ by more than the tolerance, 0 to 1
  double greatest = 0;        // greatest difference of a pixel, ΔE*ab (black to white is 100)
  double densest = 0;         // share of differing pixels in the worst window of 16 × 16 pixels, 0 to 1
  int column = 0, row = 0;    // top left corner of that window
  int width = 0, height = 0;  // of that window: smaller than 16 in smaller pictures
};

/// What is taken for the same picture. Rounding alone leaves no pixel beyond the tolerance; an edge that
/// falls on the other side of a pixel centre leaves a few, never many side by side.
struct DifferenceLimit {
  double share = 0.002;
  double densest = 0.05;
  double greatest = std::numeric_limits<double>::infinity();  // ΔE*ab
};

/// UsageError if the sizes differ.
ImageDifference compare(const Image& a, const Image& b, double tolerance = just_noticeable);

/// How many times its limit a difference is, in the worst respect: alike up to 1. The greatest of several
/// tells the worst picture.
double excess(const ImageDifference& difference, const DifferenceLimit& limit = {});

bool alike(const ImageDifference& difference, const DifferenceLimit& limit = {});

/// `a` in pale gray with the differing pixels from orange (at the tolerance) to dark red, and a frame about
/// the densest window. UsageError if the sizes differ.
Image difference_picture(const Image& a, const Image& b, double tolerance = just_noticeable);

}  // namespace taut::render
