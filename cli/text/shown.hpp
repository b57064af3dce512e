#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace taut::cli {

/// Text for a message: one line of at most `most` bytes, then "…". Control characters become "\x1b".
std::string shown(std::string_view text, std::size_t most = 200);

/// At most `most` bytes, cut between UTF-8 characters, then "…".
std::string abridged(std::string_view text, std::size_t most);

bool is_utf8(std::string_view text);

}  // namespace taut::cli
