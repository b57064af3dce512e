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
  int least_dim = 2;  // 3: of scenes in three dimensions only
};

/// Every field of scenes in `dim` dimensions, in the order in which they are listed; in three all there are.
std::span<const Field> fields(int dim = 3);
/// nullptr if there is none of that name in so many dimensions.
const Field* find_field(std::string_view key, int dim = 3);
std::vector<double> evaluate(const Field& field, const Snapshot& snapshot);

}  // namespace taut
