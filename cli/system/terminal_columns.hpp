#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>

namespace taut::cli {

/// Width of the terminal behind a file descriptor, in columns; nullopt if it is no terminal.
std::optional<std::size_t> terminal_columns(int file_descriptor);

/// Width to which text on `out` is wrapped: COLUMNS if set, else the width of the terminal behind stdout; nullopt for
/// files and pipes.
std::optional<std::size_t> text_columns(const std::ostream& out);

}  // namespace taut::cli
