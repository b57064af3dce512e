#pragma once

#include <array>
#include <optional>

#include "engine/diagnostics/curve.hpp"

namespace taut {

/// Frequency in Hz of the highest peak within `band` (THEORY.md, Peak frequency); `begin`, `end` in s. Returns none
/// for less than two periods, or if the band has no peak. Trends, impacts, round-off, side lobes and amplitudes
/// below 3e-5 of the highest are not peaks.
std::optional<double> peak_frequency(const Curve& curve, double begin, double end,
                                     const std::array<double, 2>& band);

}  // namespace taut
