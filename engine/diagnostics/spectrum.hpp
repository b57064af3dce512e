#pragma once

#include <array>
#include <optional>

#include "engine/diagnostics/curve.hpp"

namespace taut {

/// Frequency, Hz, of the highest peak in the spectrum of a curve within `band`, from `begin` to `end`, s, both within
/// the curve. None if the spectrum has no peak there or only rises towards an end of the band, or for less than two
/// periods. Trends, impacts, rounding, side lobes, and amplitudes below 3e-5 of the highest do not count as peaks.
/// Resamples evenly, subtracts a straight line, applies a Hann window and pads with zeros to four times the length;
/// the peak is the vertex of a parabola through three logarithms. Lines closer than 2/(end − begin) merge. The error
/// of a steady line is far below 1/(end − begin).
std::optional<double> peak_frequency(const Curve& curve, double begin, double end,
                                     const std::array<double, 2>& band);

}  // namespace taut
