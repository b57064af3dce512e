#include "cli/text/format.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <sstream>

#include <fmt/core.h>

#include "cli/text/shown.hpp"

namespace taut::cli {
namespace {

/// Continuation bytes of UTF-8 take no column.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string exact(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string brief(double value) { return std::isnan(value) ? "nan" : fmt::format("{:.4g}", value); }

std::string six_digits(double value) { return std::isnan(value) ? "nan" : fmt::format("{:.6g}", value); }

std::string with_prefix(double value) {
  if (value >= 1e9) return fmt::format("{:.3g} G", value / 1e9);
  if (value >= 1e6) return fmt::format("{:.3g} M", value / 1e6);
  if (value >= 1e3) return fmt::format("{:.3g} k", value / 1e3);
  return fmt::format("{:.3g}", value);
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string clock_time(double seconds) {
  const long all = std::lround(std::clamp(seconds, 0.0, 3.6e9));
  const long h = all / 3600, m = all / 60 % 60, s = all % 60;
  return h > 0 ? fmt::format("{}:{:02}:{:02}", h, m, s) : fmt::format("{}:{:02}", m, s);
}

std::string join(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += between;
    text += word;
  }
  return text;
}

std::string join_with_or(std::vector<std::string> words) {
  if (words.size() < 2) return join(words);
  const std::string last = words.back();
  words.pop_back();
  return join(words).append(" or ").append(last);
}

std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

std::string wrapped(const std::string& text, std::size_t indent, std::size_t columns) {
  std::string lines, line(indent, ' ');
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool begins = line.size() == indent;
    if (!begins && width(line) + 1 + width(word) > columns) {
      lines += line + '\n';
      line.assign(indent, ' ');
      line += word;
    } else {
      line += (begins ? "" : " ") + word;
    }
  }
  return lines + line;
}

namespace {

std::vector<std::string> lines_of(const std::string& text, std::size_t columns) {
  std::vector<std::string> lines;
  std::istringstream whole(wrapped(text, 0, columns));
  for (std::string line; std::getline(whole, line);) lines.push_back(line);
  if (lines.empty()) lines.emplace_back();
  return lines;
}

std::string table_line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths,
                       int indent) {
  std::string line(static_cast<std::size_t>(indent), ' ');
  for (std::size_t c = 0; c < cells.size(); ++c)
    line += cells[c] + std::string(std::max(widths[c], width(cells[c])) + 2 - width(cells[c]), ' ');
  return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

}  // namespace

std::string in_columns(std::vector<std::vector<std::string>> rows, int indent,
                       std::optional<std::size_t> columns) {
  for (auto& row : rows)  // cells may come from foreign files
    for (std::string& cell : row) cell = printable(cell);
  std::vector<std::size_t> padded, full;  // widths of columns; `padded` omits the last cell of each row
  for (const auto& row : rows) {
    padded.resize(std::max(padded.size(), row.size()));
    full.resize(padded.size());
    for (std::size_t c = 0; c < row.size(); ++c) {
      full[c] = std::max(full[c], width(row[c]));
      if (c + 1 < row.size()) padded[c] = std::max(padded[c], width(row[c]));
    }
  }
  std::string text;
  const std::size_t all =
      std::accumulate(full.begin(), full.end(), static_cast<std::size_t>(indent)) + 2 * full.size();
  if (!columns || full.empty() || all <= *columns + 2) {
    for (const auto& row : rows) text += table_line(row, padded, indent);
    return text;
  }
  constexpr std::size_t least = 24;
  const auto widest = static_cast<std::size_t>(std::ranges::max_element(full) - full.begin());
  const std::size_t others = all - full[widest] - 2;
  full[widest] = std::max(least, *columns - std::min(*columns, others));
  for (const auto& row : rows) {
    const std::vector<std::string> lines =
        widest < row.size() ? lines_of(row[widest], full[widest]) : std::vector<std::string>(1);
    for (const std::string& line : lines) {
      std::vector<std::string> cells = &line == &lines.front() ? row : std::vector<std::string>(widest + 1);
      if (widest < cells.size()) cells[widest] = line;
      text += table_line(cells, full, indent);
    }
  }
  return text;
}

std::string numbered(const char* name, int number, const char* extension) {
  return fmt::format("{}_{:05}.{}", name, number, extension);
}

}  // namespace taut::cli
