#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/neighbors/affine_fit.hpp"
#include "engine/snapshot.hpp"

namespace taut {

enum class Counted : std::uint8_t { nothing, bodies, materials };

struct Field {
  std::string_view key;
  std::string_view name;
  std::string_view unit;  // empty if dimensionless
  std::string_view help;
  bool is_signed = false;  // diverging colours around `middle`
  double (*of_state)(const Snapshot&, std::size_t particle) = nullptr;
  int least_dim = 2;
  double (*of_map)(const LinearMap& F) = nullptr;  // instead of `of_state`
  double middle = 0;
  Counted counts = Counted::nothing;
  std::vector<double> (*of_all)(const Snapshot&) = nullptr;
};

std::span<const Field> fields(int dim = 3);
/// Returns nullptr if unknown.
const Field* find_field(std::string_view key, int dim = 3);
std::vector<double> evaluate(const Field& field, const Snapshot& snapshot);
std::vector<std::vector<double>> evaluate(std::span<const Field* const> fields, const Snapshot& snapshot);

}  // namespace taut
