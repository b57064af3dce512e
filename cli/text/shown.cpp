#include "cli/text/shown.hpp"

#include <fmt/core.h>

namespace taut::cli {
namespace {

bool continues_letter(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }

}  // namespace

std::string shown(std::string_view text, std::size_t most) {
  std::string line;
  const bool letters = is_utf8(text);
  for (const char c : letters ? abridged(text, most) : std::string(text.substr(0, most)))
    line += is_control(c) || (!letters && (c & '\x80'))
                ? fmt::format("\\x{:02x}", static_cast<unsigned char>(c))
                : std::string(1, c);
  return line;
}

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
