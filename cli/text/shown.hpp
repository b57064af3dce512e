#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace taut::cli {

/// A text of a file as a message shows it: in one line, at most `most` bytes long with "…" for the rest, and
/// with "\x1b" for what a terminal would obey.
std::string shown(std::string_view text, std::size_t most = 200);

/// The first `most` bytes of UTF-8 text, or fewer: no half letter, and "…" for what is left away.
std::string abridged(std::string_view text, std::size_t most);

bool is_utf8(std::string_view text);

}  // namespace taut::cli
