#pragma once

#include <string>
#include <vector>

namespace taut::cli {

/// A method has one style in all pictures. Lines of one method or colour differ in dashes.
struct CurveStyle {
  std::string color;         // "#0072B2"
  int dash = 1;              // of gnuplot; 1: solid
  int filled = 7, open = 6;  // gnuplot's point types

  std::string line() const;    // "linecolor '#0072B2' dashtype 1"
  std::string marker() const;  // "pointtype 7 linecolor '#0072B2'"
};

std::vector<CurveStyle> curve_styles(const std::vector<std::string>& methods);
/// Styles of lines without markers. Lines of one method, or that would look alike, get colours from dark to light.
std::vector<CurveStyle> line_styles(const std::vector<std::string>& methods);
/// Style of line number `k` where lines are no methods.
CurveStyle numbered_style(std::size_t k);
/// Gnuplot style of references: black dashes.
inline constexpr const char* reference_line = "with lines linewidth 1.5 linecolor '#111111' dashtype '-'";
inline constexpr std::size_t most_distinct_lines = 24;  // distinguishable lines

}  // namespace taut::cli
