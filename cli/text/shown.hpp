#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace taut::cli {

/// Makes one line: cuts a text longer than `most` bytes and appends "…". Escapes control characters, as in "\x1b".
std::string shown(std::string_view text, std::size_t most = 200);

/// Escapes control characters (except line breaks), C1 controls and bidirectional marks.
std::string printable(std::string_view text);

/// Cuts a text longer than `most` bytes between UTF-8 characters and appends "…".
std::string abridged(std::string_view text, std::size_t most);

bool is_utf8(std::string_view text);

}  // namespace taut::cli
