#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Nullopt unless all of `text` is a number; accepts inf and nan.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

/// Shortest text that reads back exactly.
std::string exact(double value);
/// At most four significant digits.
std::string brief(double value);
std::string six_digits(double value);
/// "4.1 M".
std::string with_prefix(double value);
/// "12 %" for 0.12.
std::string percent(double share);
/// "0:07" or "1:02:03".
std::string clock_time(double seconds);
std::string join(const std::vector<std::string>& words, std::string_view between = ", ");
std::string join_with_or(std::vector<std::string> words);

/// FNV-1a.
std::uint64_t hash_of(std::string_view text);

/// Wraps the widest column if the table is wider than `columns`. Escapes cells with printable().
std::string in_columns(std::vector<std::vector<std::string>> rows, int indent = 2,
                       std::optional<std::size_t> columns = {});
/// Breaks `text` at blanks. Each line begins with `indent` blanks; the last has no newline.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t columns);

/// "NAME_00012.EXTENSION"
std::string numbered(const char* name, int number, const char* extension);

}  // namespace taut::cli
