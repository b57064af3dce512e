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
/// For lines without markers. Lines of one colour get shades, and lines of a single method get colours, from dark to
/// light. Methods with one line each keep their own styles, unless `has_columns`: the dashes then belong to columns.
std::vector<CurveStyle> line_styles(const std::vector<std::string>& methods, bool has_columns = false);
/// For lines that stand for no method.
CurveStyle numbered_style(std::size_t k);
inline constexpr const char* reference_line = "with lines linewidth 1.5 linecolor '#111111' dashtype '-'";
inline constexpr std::size_t most_distinct_lines = 24;

}  // namespace taut::cli
