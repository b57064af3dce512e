#pragma once

#include <array>
#include <optional>

#include "engine/diagnostics/curve.hpp"

namespace taut {

/// The frequency, Hz, of the highest peak that the spectrum of a curve has within `band`, from `begin` to
/// `end`, s, both within the curve; none where it has none, as where it only rises towards an end of the
/// band, and of less than two periods. What a trend, a blow, rounding or a higher line beside it leaves in the spectrum
/// is no peak, nor is what is 3e-5 as high as the highest in the spectrum or less.
///
/// The curve is sampled evenly at the next power of two above its own samples, a straight line is taken off, a Hann
/// window laid over it, and four times as many points filled up with 0, so that a peak is four points wide or
/// more; its top is that of the parabola through the logarithms of three. Two lines less than 2/(end − begin)
/// apart are one. A line that lasts has an error far below 1/(end − begin).
std::optional<double> peak_frequency(const Curve& curve, double begin, double end,
                                     const std::array<double, 2>& band);

}  // namespace taut
