#pragma once

#include "render/image/image.hpp"

namespace taut::render {

/// CIE 1976 L*a*b*, white point D65.
struct Lab {
  double L, a, b;
};

Lab lab_of(Rgb color);

/// ΔE*ab; black to white is 100.
double color_difference(Rgb a, Rgb b);

}  // namespace taut::render
