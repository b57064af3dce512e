#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/neighbors/affine_fit.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// What the numbers of a field count, if they are no quantity: each has a name and a colour of its own.
enum class Counted : std::uint8_t { nothing, bodies, materials };

/// A quantity per particle that can be drawn or written.
struct Field {
  std::string_view key;   // "von_mises", as on the command line
  std::string_view name;  // "von Mises stress", as on the colour bar
  std::string_view unit;  // "Pa"; of a pure number empty
  std::string_view help;
  bool is_signed = false;  // about `middle`: drawn with a diverging colour map by default
  double (*of_state)(const Snapshot&, std::size_t particle) = nullptr;
  int least_dim = 2;                               // 3: of scenes in three dimensions only
  double (*of_map)(const LinearMap& F) = nullptr;  // in place of `of_state`, see affine_fit.hpp
  double middle = 0;                               // of a signed field
  Counted counts = Counted::nothing;

  /// At one particle; for many of them `evaluate` is quicker.
  double value(const Snapshot& now, std::size_t particle) const;
};

/// Every field of scenes in `dim` dimensions, in the order in which they are listed; in three all there are.
std::span<const Field> fields(int dim = 3);
/// nullptr if there is none of that name in so many dimensions.
const Field* find_field(std::string_view key, int dim = 3);
std::vector<double> evaluate(const Field& field, const Snapshot& snapshot);
/// Several at once, which fits the affine maps once for all that need them.
std::vector<std::vector<double>> evaluate(std::span<const Field* const> fields, const Snapshot& snapshot);

}  // namespace taut
