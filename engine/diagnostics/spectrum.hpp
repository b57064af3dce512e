#pragma once

#include <array>
#include <optional>

#include "engine/diagnostics/curve.hpp"

namespace taut {

/// Frequency of the highest peak of a curve within `band`, Hz; `begin`, `end` in s. None for less than two periods or
/// if there is no peak. Trends, impacts, round-off, side lobes and amplitudes below 3e-5 of the highest are not
/// peaks.
/// Uses even samples minus a line, a Hann window, fourfold zero padding, and a parabola through logarithms. Lines
/// closer than 2/(end − begin) merge.
std::optional<double> peak_frequency(const Curve& curve, double begin, double end,
                                     const std::array<double, 2>& band);

}  // namespace taut
