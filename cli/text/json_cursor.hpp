#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "cli/text/json.hpp"

namespace taut::cli {

/// Its UsageErrors contain the file and the path of the key.
class JsonCursor {
 public:
  /// The arguments must outlive the cursor. With `texts_are_numbers`, as in CSV, number() parses texts.
  JsonCursor(const Json& value, const std::string& file, std::string path = "",
             bool texts_are_numbers = false);

  const std::string& path() const { return path_; }
  bool is_null() const;
  bool is_missing() const;
  /// Null for a missing key.
  JsonCursor at(const std::string& key) const;
  /// Empty for null.
  std::vector<std::pair<std::string, JsonCursor>> members() const;
  std::vector<JsonCursor> items() const;
  /// "" for null.
  std::string text() const;
  std::string number_or_text() const;

  void check_object() const;
  std::optional<double> number() const;
  /// Null gives NaN, or 0 for an integer T. Integers beyond ±1e9 (64-bit: ±1e18) give 0.
  template <class T>
  T number_as() const {
    const double value = number().value_or(NAN);
    if constexpr (std::is_integral_v<T>)
      return std::abs(value) <= 1e9 || (sizeof(T) > 4 && std::abs(value) <= 1e18) ? static_cast<T>(value) : 0;
    else
      return value;
  }
  /// "" for null.
  std::string choice(const std::vector<std::string>& allowed) const;
  [[noreturn]] void fail(const std::string& allowed) const;

 private:
  const Json* value_;
  const std::string* file_;
  std::string path_;
  bool texts_are_numbers_;
};

}  // namespace taut::cli
