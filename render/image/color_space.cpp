#include "render/image/color_space.hpp"

#include <array>
#include <cmath>

namespace taut::render {
namespace {

/// Linear light (IEC 61966-2-1).
std::array<double, 256> linear_table() {
  std::array<double, 256> table;
  for (int i = 0; i < 256; ++i) {
    const double v = i / 255.0;
    table[static_cast<std::size_t>(i)] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  return table;
}

/// Lightness (CIE 15).
double lightness_root(double t) {
  constexpr double delta = 6.0 / 29.0;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29.0;
}

}  // namespace

Lab lab_of(Rgb color) {
  static const std::array<double, 256> linear = linear_table();
  const double r = linear[color[0]];
  const double g = linear[color[1]];
  const double b = linear[color[2]];
  // sRGB to XYZ, divided by the white point D65
  const double x = lightness_root((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
  const double y = lightness_root(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
  const double z = lightness_root((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double color_difference(Rgb a, Rgb b) {
  if (a == b) return 0;
  const Lab p = lab_of(a);
  const Lab q = lab_of(b);
  return std::sqrt((p.L - q.L) * (p.L - q.L) + (p.a - q.a) * (p.a - q.a) + (p.b - q.b) * (p.b - q.b));
}

}  // namespace taut::render
