#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>

namespace taut::cli {

/// Nullopt if the file is no terminal.
std::optional<std::size_t> terminal_columns(int file_descriptor);

/// Width of std::cout: COLUMNS if set, else the width of its terminal, if any. Nullopt for other streams.
std::optional<std::size_t> text_columns(const std::ostream& out);

}  // namespace taut::cli
