#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/drawing/keys.hpp"

namespace taut::cli {

using Numbers = std::vector<double>;

inline bool is_word(const DrawingValue& value) { return std::holds_alternative<std::string>(value); }
inline const std::string& word(const DrawingValue& value) { return std::get<std::string>(value); }
inline const Numbers& numbers(const DrawingValue& value) { return std::get<Numbers>(value); }
inline DrawingValue left_open() { return std::string(automatic); }

/// "font_size = 0.5 must be from 1 to 100".
std::string number_out_of_bounds(std::string_view key, double value, std::string_view bounds);
bool is_whole_within(double value, int low, int high);
std::vector<std::string> split_at_commas(const std::string& text);

inline constexpr std::string_view right_lines = "one line of UTF-8 text of at most 200 bytes";
/// Returns a message, or "" for a valid line.
std::string line_of_text(const std::string& text);

inline constexpr std::string_view right_colors =
    "white, black, transparent or #rrggbb (six hexadecimal digits)";
inline constexpr double least_font = 1, greatest_font = 100, least_dpi = 30, greatest_dpi = 2400;
std::vector<std::string> names_of_texts();
std::string set_size(Drawing& drawing, const DrawingValue& value);
DrawingValue get_size(const Drawing& drawing);
std::string set_background(Drawing& drawing, const DrawingValue& value);
DrawingValue get_background(const Drawing& drawing);
std::string set_texts(Drawing& drawing, const DrawingValue& value);
DrawingValue get_texts(const Drawing& drawing);
inline constexpr std::string_view right_formats =
    "auto, %.Nf (N decimals) or %.Ne (powers of ten), N from 0 to 9";
std::vector<std::string> names_of_bar_positions();
std::string set_bar_position(Drawing& drawing, const DrawingValue& value);
DrawingValue get_bar_position(const Drawing& drawing);
std::string set_bar_format(Drawing& drawing, const DrawingValue& value);
DrawingValue get_bar_format(const Drawing& drawing);
std::vector<std::string> names_of_axes_positions();
std::string set_axes_position(Drawing& drawing, const DrawingValue& value);
DrawingValue get_axes_position(const Drawing& drawing);
std::string set_title(Drawing& drawing, const DrawingValue& value);
DrawingValue get_title(const Drawing& drawing);
std::string set_font_size(Drawing& drawing, const DrawingValue& value);
DrawingValue get_font_size(const Drawing& drawing);
std::string set_width(Drawing& drawing, const DrawingValue& value);
DrawingValue get_width(const Drawing& drawing);
std::string set_dpi(Drawing& drawing, const DrawingValue& value);
DrawingValue get_dpi(const Drawing& drawing);

}  // namespace taut::cli
