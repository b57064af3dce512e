#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace taut::cli {

/// A text of a file as a message shows it: in one line, at most `most` bytes long with "…" for the rest, and
/// with "\x1b" for what a terminal would obey.
std::string shown(std::string_view text, std::size_t most = 200);

/// The same for a text of any length, in which line breaks stay: for whatever is printed on a terminal. Escapes C1
/// controls and marks of the direction of writing as well.
std::string printable(std::string_view text);

/// The first `most` bytes of UTF-8 text, or fewer: no half letter, and "…" for what is left away.
std::string abridged(std::string_view text, std::size_t most);

bool is_utf8(std::string_view text);

}  // namespace taut::cli
