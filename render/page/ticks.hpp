#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::render {

/// How a quantity is shown: `value * factor` in `unit`, e.g. 1e-6 and "MPa".
struct Scale {
  double factor = 1;
  std::string unit;
};

/// An SI prefix, or a power of ten where the unit takes no prefix ("10⁻³", "10⁶ 1/s"), such that numbers up
/// to `greatest` have at most three digits before the point.
Scale scale_for(double greatest, std::string_view unit);

/// A round value of an axis.
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

/// The greatest of 1, 2, 5 times a power of ten that is not above `length` > 0.
double nice_length(double length);

/// With a typographic minus; never "−0".
std::string format_fixed(double value, int decimals);

/// "5.004 ms". With the time of the last frame, `until`, every frame of a sequence has the same unit.
std::string format_time(double t, double until = 0);

}  // namespace taut::render
