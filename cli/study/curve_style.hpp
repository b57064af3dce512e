#pragma once

#include <string>
#include <vector>

namespace taut::cli {

struct CurveStyle {
  std::string color;         // "#0072B2"
  int dash = 1;              // 1: solid
  int filled = 7, open = 6;  // gnuplot's point types

  std::string line() const;
  std::string marker() const;
};

/// The first line of a method has the same style in all pictures.
std::vector<CurveStyle> curve_styles(const std::vector<std::string>& methods);
/// Number of pairs of a colour and a marker.
std::size_t most_marked_lines();
/// For lines without markers. If some would look alike, or all have one method, all get colours from dark to light.
std::vector<CurveStyle> line_styles(const std::vector<std::string>& methods);
/// For lines that stand for no method.
CurveStyle numbered_style(std::size_t k);
inline constexpr const char* reference_line = "with lines linewidth 1.5 linecolor '#111111' dashtype '-'";
inline constexpr std::size_t most_distinct_lines = 24;

}  // namespace taut::cli
