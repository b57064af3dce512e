#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// A quantity per particle that can be drawn or written.
struct Field {
  std::string_view key;   // "von_mises", as on the command line
  std::string_view name;  // "von Mises stress", as on the colour bar
  std::string_view unit;  // "Pa"
  std::string_view help;
  bool is_signed;  // drawn with a diverging colour map by default
  double (*value)(const Snapshot&, std::size_t particle);
};

/// Every field, in the order in which they are listed.
std::span<const Field> fields();
/// nullptr if there is none of that name.
const Field* find_field(std::string_view key);
std::vector<double> evaluate(const Field& field, const Snapshot& snapshot);

}  // namespace taut
