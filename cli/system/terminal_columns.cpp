#include "cli/system/terminal_columns.hpp"

#include <cstdlib>
#include <iostream>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/text/format.hpp"

namespace taut::cli {

std::optional<std::size_t> terminal_columns(int file_descriptor) {
  winsize size{};
  if (::ioctl(file_descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
  return size.ws_col;
}

std::optional<std::size_t> text_columns(const std::ostream& out) {
  if (&out != &std::cout) return std::nullopt;
  if (const char* const given = std::getenv("COLUMNS"))
    if (const auto columns = parsed<std::size_t>(given); columns && *columns > 0) return columns;
  return terminal_columns(STDOUT_FILENO);
}

}  // namespace taut::cli
