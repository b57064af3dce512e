#pragma once

#include <optional>
#include <string_view>

namespace taut::cli {

inline constexpr double mm_per_inch = 25.4, points_per_inch = 72;
inline constexpr double screen_dpi = 96, print_dpi = 300;
/// Points; most journals allow 6 to 8.
inline constexpr double print_font = 7;

/// Millimetres of "85mm", "8.5cm" or "3.35in", from 10 mm to 2 m.
std::optional<double> parsed_print_width(std::string_view text);
inline constexpr std::string_view right_print_widths =
    "a length with mm, cm or in, such as 85mm, from 10 mm to 2000 mm";

}  // namespace taut::cli
