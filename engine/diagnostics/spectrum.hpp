#pragma once

#include <array>
#include <optional>

#include "engine/diagnostics/curve.hpp"

namespace taut {

/// Frequency of the highest peak within `band`, Hz, of a curve from `begin` to `end`, s. None for less than two
/// periods, or if the spectrum only rises towards an end of the band. Trends, impacts, round-off, side lobes and
/// amplitudes below 3e-5 are not peaks.
/// Uses evenly spaced samples minus a line, a Hann window, zeros up to four times the length, and a parabola through
/// three logarithms. Lines closer than 2/(end − begin) merge.
std::optional<double> peak_frequency(const Curve& curve, double begin, double end,
                                     const std::array<double, 2>& band);

}  // namespace taut
