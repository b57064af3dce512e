#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::render {

/// Conversion for display: `value * factor` in `unit`, e.g. 1e-6 and "MPa".
struct Scale {
  double factor = 1;
  std::string unit;
};

/// Selects an SI prefix, or a power of ten if the unit takes none ("10⁻³", "10⁶ 1/s"), such that numbers up to
/// `greatest` have at most three digits before the point.
Scale scale_for(double greatest, std::string_view unit);

/// A round value on an axis.
struct Tick {
  double value;       // in the unit of the range
  std::string label;  // in the unit of the scale
};

struct Ticks {
  std::vector<Tick> at;
  std::string unit;
};

/// At most `most` (2 or more) ticks at multiples of 1, 2 or 5 times a power of ten within [low, high].
Ticks nice_ticks(double low, double high, std::string_view unit, int most);

/// Greatest 1, 2 or 5 times a power of ten that is at most `length` > 0.
double nice_length(double length);

/// Formats with a typographic minus; never "−0".
std::string format_fixed(double value, int decimals);

/// Formats "5.004 ms". With `until`, the time of the last frame, all frames use the same unit.
std::string format_time(double t, double until = 0);

}  // namespace taut::render
