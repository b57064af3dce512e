#pragma once

#include <string>

namespace taut::cli {

// Return a message, or "" for a valid text.
std::string positive_number(const std::string& text);
std::string not_negative_number(const std::string& text);
std::string positive_whole_number(const std::string& text);
std::string whole_number(const std::string& text);
std::string png_name(const std::string& text);
std::string assignment(const std::string& text);

}  // namespace taut::cli
