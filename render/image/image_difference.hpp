#pragma once

#include <limits>

#include "render/image/image.hpp"

namespace taut::render {

/// ΔE*ab; rounding on another processor stays well below.
inline constexpr double just_noticeable = 2.3;

/// Differences of two pictures of one size. The share measures widespread changes, the densest window local ones,
/// such as one moved particle.
struct ImageDifference {
  double share = 0;           // of pixels beyond the tolerance, 0 to 1
  double greatest = 0;        // ΔE*ab (black to white is 100)
  double densest = 0;         // share in the worst window of 16 × 16 pixels
  int column = 0, row = 0;    // top left corner of that window
  int width = 0, height = 0;  // less than 16 in smaller pictures
};

/// Limits for equal pictures. Rounding may move edges across pixel centres, but rarely side by side.
struct DifferenceLimit {
  double share = 0.002;
  double densest = 0.05;
  double greatest = std::numeric_limits<double>::infinity();  // ΔE*ab
};

/// UsageError if the sizes differ.
ImageDifference compare(const Image& a, const Image& b, double tolerance = just_noticeable);

/// Greatest ratio to a limit; alike up to 1.
double excess(const ImageDifference& difference, const DifferenceLimit& limit = {});

bool alike(const ImageDifference& difference, const DifferenceLimit& limit = {});

/// `a` in pale gray, differing pixels from orange (at the tolerance) to dark red, the densest window framed.
/// UsageError if the sizes differ.
Image difference_picture(const Image& a, const Image& b, double tolerance = just_noticeable);

}  // namespace taut::render
