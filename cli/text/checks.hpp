#pragma once

#include <string>

namespace taut::cli {

// Checks of an option's text: each returns a description of the problem, or "". CLI11's own checks are not used,
// since they print the bounds of a double with 309 digits.
std::string positive_number(const std::string& text);
std::string not_negative_number(const std::string& text);
std::string positive_whole_number(const std::string& text);
std::string whole_number(const std::string& text);
/// Accepts only names of PNG files.
std::string png_name(const std::string& text);
/// Accepts "name=value".
std::string assignment(const std::string& text);

}  // namespace taut::cli
