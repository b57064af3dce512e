#pragma once

#include <string>
#include <vector>

namespace taut::cli {

/// How a method looks in every picture: the same colour and marker in charts, histories and maps. Methods
/// that share a colour, and lines of one method, differ in dashes.
struct CurveStyle {
  std::string color;         // "#0072B2"
  int dash = 1;              // of gnuplot: 1 is solid
  int filled = 7, open = 6;  // markers of gnuplot

  std::string line() const;    // "linecolor '#0072B2' dashtype 1"
  std::string marker() const;  // "pointtype 7 linecolor '#0072B2'", of a run that was stable
};

/// Of lines of these methods, of which some may be there several times.
std::vector<CurveStyle> curve_styles(const std::vector<std::string>& methods);
/// The same for lines without markers: where these would look alike, or are all of one method, colours from
/// dark to light in their order.
std::vector<CurveStyle> line_styles(const std::vector<std::string>& methods);
inline constexpr std::size_t most_told_apart = 24;  // lines by these colours and dashes

}  // namespace taut::cli
