#pragma once

#include <string>

namespace taut::cli {

// Checks of an option's text: each returns the problem, or nothing. The checks of CLI11 show the bounds of a
// double with 309 digits.
std::string positive_number(const std::string& text);
std::string not_negative_number(const std::string& text);
std::string positive_whole_number(const std::string& text);
std::string whole_number(const std::string& text);
/// The name of a picture that is written as PNG, whatever it is called.
std::string png_name(const std::string& text);
/// "name=value"
std::string assignment(const std::string& text);

}  // namespace taut::cli
