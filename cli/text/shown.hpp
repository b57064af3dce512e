#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace taut::cli {

/// One line of at most `most` bytes, then "…". Control characters become "\x1b".
std::string shown(std::string_view text, std::size_t most = 200);

/// Escapes control characters but line breaks, C1 controls and marks of direction.
std::string printable(std::string_view text);

/// Cuts between UTF-8 characters, then "…".
std::string abridged(std::string_view text, std::size_t most);

bool is_utf8(std::string_view text);

}  // namespace taut::cli
