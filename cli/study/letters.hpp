#pragma once

#include <string>
#include <string_view>

namespace taut::cli {

/// Replaces letters (UTF-8) without a font by '□': Pango, which draws gnuplot's PNG, would draw huge boxes.
std::string with_letters_of_fonts(std::string_view text);

}  // namespace taut::cli
