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

}  // namespace taut::cli
