#pragma once

#include <string>
#include <string_view>

namespace taut::cli {

/// Replaces each letter (UTF-8) that no installed font has by '□'. Pango, which draws the texts of gnuplot's PNG,
/// would draw a huge box for it.
std::string with_letters_of_fonts(std::string_view text);

}  // namespace taut::cli
