#pragma once

#include <array>
#include <optional>

#include "engine/diagnostics/curve.hpp"

namespace taut {

/// Frequency in Hz of the highest peak within `band` (THEORY.md, Peak frequency); `begin`, `end` in s. Returns none if
/// the band has no peak.
std::optional<double> peak_frequency(const Curve& curve, double begin, double end,
                                     const std::array<double, 2>& band);

}  // namespace taut
