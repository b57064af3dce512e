#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>

namespace taut::cli {

/// Width of the terminal behind a file descriptor, in columns; none if it is not a terminal.
std::optional<std::size_t> terminal_columns(int file_descriptor);

/// Width to which text on `out` is wrapped: COLUMNS where it is set, else the terminal behind stdout; none for a file
/// or a pipe.
std::optional<std::size_t> text_columns(const std::ostream& out);

}  // namespace taut::cli
