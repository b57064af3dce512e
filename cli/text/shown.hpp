#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace taut::cli {

/// Cuts a text longer than `most` bytes, then escapes it like printable(), including line breaks.
std::string shown(std::string_view text, std::size_t most = 200);

/// Escapes bidirectional marks and all control characters except line breaks, as in "\x1b". In invalid UTF-8, also
/// escapes all bytes from 0x80.
std::string printable(std::string_view text);

/// Cuts a text longer than `most` bytes between UTF-8 characters and appends "…".
std::string abridged(std::string_view text, std::size_t most);

bool is_utf8(std::string_view text);

}  // namespace taut::cli
