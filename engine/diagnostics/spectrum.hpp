#pragma once

#include <array>
#include <optional>

#include "engine/diagnostics/curve.hpp"

namespace taut {

/// Frequency of the highest peak within `band`, Hz; `begin`, `end` in s. Returns none for less than two periods, or
/// if the band has no peak. Trends, impacts, round-off, side lobes and amplitudes below 3e-5 of the highest are not
/// peaks.
/// Subtracts a linear fit, applies a Hann window and pads with zeros to four times the length. A parabola through
/// the logarithms of three points locates the peak. Lines closer than 2/(end − begin) merge; the error of a lasting
/// line is far below 1/(end − begin).
std::optional<double> peak_frequency(const Curve& curve, double begin, double end,
                                     const std::array<double, 2>& band);

}  // namespace taut
