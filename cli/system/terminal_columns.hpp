#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>

namespace taut::cli {

/// Nullopt if the file is no terminal.
std::optional<std::size_t> terminal_columns(int file_descriptor);

/// COLUMNS, or the width of the terminal. Nullopt for streams except std::cout.
std::optional<std::size_t> text_columns(const std::ostream& out);

}  // namespace taut::cli
