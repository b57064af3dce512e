#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>

namespace taut::cli {

/// Returns nullopt if there is no terminal.
std::optional<std::size_t> terminal_columns(int file_descriptor);

/// Returns COLUMNS if set, else the terminal's width; nullopt for files and pipes.
std::optional<std::size_t> text_columns(const std::ostream& out);

}  // namespace taut::cli
