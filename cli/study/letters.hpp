#pragma once

#include <string>
#include <string_view>

namespace taut::cli {

/// Replaces letters without a font by '□', for which Pango, in gnuplot's PNG, would draw huge boxes.
std::string with_letters_of_fonts(std::string_view text);

}  // namespace taut::cli
