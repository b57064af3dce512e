#include "cli/text/shown.hpp"

#include <fmt/core.h>

namespace taut::cli {
namespace {

bool continues_letter(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }

/// Length in bytes of a leading C1 control or bidirectional mark (U+061C, U+200E, U+200F, U+202A to U+202E,
/// U+2066 to U+2069), or 0.
std::size_t length_of_mark(std::string_view text) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0; };
  const auto between = [](int value, int low, int high) { return low <= value && value <= high; };
  if ((byte(0) == 0xC2 && between(byte(1), 0x80, 0x9F)) || (byte(0) == 0xD8 && byte(1) == 0x9C)) return 2;
  if (byte(0) != 0xE2) return 0;
  const bool mark = (byte(1) == 0x80 && (between(byte(2), 0x8E, 0x8F) || between(byte(2), 0xAA, 0xAE))) ||
                    (byte(1) == 0x81 && between(byte(2), 0xA6, 0xA9));
  return mark ? 3 : 0;
}

std::string escaped(std::string_view text, bool keeps_lines) {
  std::string result;
  const bool letters = is_utf8(text);
  for (std::size_t k = 0, of_mark = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (letters && of_mark == 0) of_mark = length_of_mark(text.substr(k));
    const bool escapes = (is_control(c) && !(keeps_lines && c == '\n')) || (!letters && (c & '\x80'));
    result +=
        escapes || of_mark > 0 ? fmt::format("\\x{:02x}", static_cast<unsigned char>(c)) : std::string(1, c);
    if (of_mark > 0) --of_mark;
  }
  return result;
}

}  // namespace

std::string shown(std::string_view text, std::size_t most) {
  return escaped(is_utf8(text) ? abridged(text, most) : std::string(text.substr(0, most)),
                 /*keeps_lines=*/false);
}

std::string printable(std::string_view text) { return escaped(text, /*keeps_lines=*/true); }

std::string abridged(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  while (most > 0 && continues_letter(text[most])) --most;
  return std::string(text.substr(0, most)) + "…";
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length = lead < 0x80       ? 1
                               : lead >> 5 == 6  ? 2
                               : lead >> 4 == 14 ? 3
                               : lead >> 3 == 30 ? 4
                                                 : 0;
    if (length == 0 || length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k)
      if (!continues_letter(text[k])) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace taut::cli
