#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

struct ParticleArray {
  enum class Type : std::uint8_t { real, whole, flag };

  std::string_view name;
  std::string_view unit;  // empty: dimensionless
  std::vector<double> values;
  Type type = Type::real;
  std::span<const std::string_view> components{};  // "x", "y", "z"; empty: scalar

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// Names, in VTK's order.
std::span<const std::string_view> tensor_components();

/// Includes the tensors of stress (Cauchy, positive in tension) and strain (logarithmic, ½ ln F Fᵀ) if `fields` contain
/// a component. Vectors have three components also in 2D.
std::vector<ParticleArray> particle_arrays(const Snapshot& now, std::span<const Field* const> fields);

/// Three components each, m.
ParticleArray position_array(const Snapshot& now);

}  // namespace taut::cli
