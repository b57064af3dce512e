#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// The number that all of `text` is, finite or not; none if it is no number.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

/// The shortest text that reads back as the same number.
std::string exact(double value);
/// At most four digits, for people.
std::string brief(double value);
/// At most six digits, for people who compare.
std::string six_digits(double value);
/// "4.1 M", for rates.
std::string with_prefix(double value);
/// "12 %" of a share.
std::string percent(double share);
/// "0:07" or "1:02:03".
std::string clock_time(double seconds);
std::string join(const std::vector<std::string>& words, std::string_view between = ", ");
/// "a, b or c".
std::string join_with_or(std::vector<std::string> words);

/// The same for a text on every machine (FNV-1a).
std::uint64_t hash_of(std::string_view text);

/// Rows of cells in columns, with two blanks between columns and `indent` blanks before the first. A table wider than
/// `columns` wraps the cells of its widest column.
std::string in_columns(std::vector<std::vector<std::string>> rows, int indent = 2,
                       std::optional<std::size_t> columns = {});
/// Words of `text` on lines of at most `columns`, each after `indent` blanks, without a newline at the end.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t columns);

/// "NAME_00012.EXTENSION"
std::string numbered(const char* name, int number, const char* extension);

}  // namespace taut::cli
