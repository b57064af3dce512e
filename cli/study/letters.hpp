#pragma once

#include <string>
#include <string_view>

namespace taut::cli {

/// The text (UTF-8) with '□' for each letter that no font of this system has: Pango, which draws the texts of gnuplot's
/// PNG, has a box with its number for it, and that a thousand times too large.
std::string with_letters_of_fonts(std::string_view text);

}  // namespace taut::cli
