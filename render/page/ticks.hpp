#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::render {

/// Factor and unit of shown numbers, e.g. 1e-6 and "MPa".
struct Scale {
  double factor = 1;
  std::string unit;
};

/// Chooses an SI prefix from f to T, but no ks. Units that take no prefix, such as 1/s, get a power of ten below 0.01
/// and from 1e4 on.
Scale scale_for(double greatest, std::string_view unit);

struct Tick {
  double value;
  std::string label;
};

struct Ticks {
  std::vector<Tick> at;
  std::string unit;
};

struct NumberFormat {
  std::optional<int> decimals{};  // default: as few as possible
  bool scientific = false;        // "1.5×10⁶" in the SI unit
  bool operator==(const NumberFormat&) const = default;
};

/// Up to `most` ≥ 2 ticks at multiples of 1, 2 or 5 × 10ⁿ. Numbers are exact: if `format` has too few decimals,
/// ticks are farther apart or have more decimals.
Ticks nice_ticks(double low, double high, std::string_view unit, int most, const NumberFormat& format = {});

/// Rounds `length` > 0 down to 1, 2 or 5 × 10ⁿ.
double nice_length(double length);

/// Formats with a typographic minus; never "−0".
std::string format_fixed(double value, int decimals);

/// Formats `t` (in s) as "t = 5.004 ms". With the last time `until` (in s), all times have the same unit.
std::string format_time(double t, double until = 0);

}  // namespace taut::render
