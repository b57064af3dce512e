#include "cli/text/print_size.hpp"

#include <array>
#include <utility>

#include "cli/text/format.hpp"

namespace taut::cli {

std::optional<double> parsed_print_width(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 3> units{
      {{"mm", 1}, {"cm", 10}, {"in", mm_per_inch}}};
  constexpr double least = 10, greatest = 2000;
  for (const auto& [unit, factor] : units) {
    if (!text.ends_with(unit)) continue;
    const auto number = parsed<double>(text.substr(0, text.size() - unit.size()));
    if (number && *number * factor >= least && *number * factor <= greatest) return *number * factor;
  }
  return std::nullopt;
}

}  // namespace taut::cli
