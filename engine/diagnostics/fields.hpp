#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/neighbors/affine_fit.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Objects that a field counts; each has a name and colour of its own.
enum class Counted : std::uint8_t { nothing, bodies, materials };

/// A quantity per particle that can be drawn or written.
struct Field {
  std::string_view key;   // "von_mises", on the command line
  std::string_view name;  // "von Mises stress", on the colour bar
  std::string_view unit;  // "Pa"; empty if dimensionless
  std::string_view help;
  bool is_signed = false;  // around `middle`: diverging colour map by default
  double (*of_state)(const Snapshot&, std::size_t particle) = nullptr;
  int least_dim = 2;                               // 3: only in 3D
  double (*of_map)(const LinearMap& F) = nullptr;  // replaces `of_state`, see affine_fit.hpp
  double middle = 0;
  Counted counts = Counted::nothing;

  /// At one particle; `evaluate` is faster for many.
  double value(const Snapshot& now, std::size_t particle) const;
};

/// Fields of scenes in `dim` dimensions in listing order; `dim` = 3 includes all.
std::span<const Field> fields(int dim = 3);
/// nullptr if there is none with this key in `dim` dimensions.
const Field* find_field(std::string_view key, int dim = 3);
std::vector<double> evaluate(const Field& field, const Snapshot& snapshot);
/// Evaluates several fields with one fit of the affine maps.
std::vector<std::vector<double>> evaluate(std::span<const Field* const> fields, const Snapshot& snapshot);

}  // namespace taut
