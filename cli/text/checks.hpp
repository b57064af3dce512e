#pragma once

#include <string>

namespace taut::cli {

// Each returns the problem, or "". CLI11's own checks print the bounds of a double with 309 digits.
std::string positive_number(const std::string& text);
std::string not_negative_number(const std::string& text);
std::string positive_whole_number(const std::string& text);
std::string whole_number(const std::string& text);
std::string png_name(const std::string& text);
/// "name=value".
std::string assignment(const std::string& text);

}  // namespace taut::cli
