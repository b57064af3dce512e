#pragma once

#include <string>
#include <string_view>

namespace taut::cli {

/// Replaces letters that no font has by '□'; Pango would draw a huge box.
std::string with_letters_of_fonts(std::string_view text);

}  // namespace taut::cli
