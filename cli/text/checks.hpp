#pragma once

#include <string>

namespace taut::cli {

// Each check returns a problem, or "". CLI11's own checks show bounds of doubles with 309 digits.
std::string positive_number(const std::string& text);
std::string not_negative_number(const std::string& text);
std::string positive_whole_number(const std::string& text);
std::string whole_number(const std::string& text);
/// Pictures are PNG files.
std::string png_name(const std::string& text);
std::string assignment(const std::string& text);

}  // namespace taut::cli
