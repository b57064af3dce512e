#include "cli/text/checks.hpp"

#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "cli/text/format.hpp"

namespace taut::cli {

std::string positive_number(const std::string& text) {
  const auto value = parsed<double>(text);
  return value && std::isfinite(*value) && *value > 0 ? ""
                                                      : fmt::format("'{}' must be a number above 0", text);
}

std::string not_negative_number(const std::string& text) {
  const auto value = parsed<double>(text);
  return value && std::isfinite(*value) && *value >= 0
             ? ""
             : fmt::format("'{}' must be a number of at least 0", text);
}

std::string positive_whole_number(const std::string& text) {
  const auto value = parsed<int>(text);
  return value && *value > 0 ? "" : fmt::format("'{}' must be a whole number of at least 1", text);
}

std::string whole_number(const std::string& text) {
  const auto value = parsed<int>(text);
  return value && *value >= 0 ? "" : fmt::format("'{}' must be a whole number of at least 0", text);
}

std::string png_name(const std::string& text) {
  return text.ends_with(".png") ? "" : fmt::format("'{}' must end in .png", text);
}

std::string assignment(const std::string& text) {
  const std::size_t at = text.find('=');
  return at != std::string::npos && at > 0 && at + 1 < text.size()
             ? ""
             : fmt::format("'{}' must have the form NAME=VALUE", text);
}

}  // namespace taut::cli
