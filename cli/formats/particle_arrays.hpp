#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

/// One quantity of all particles, as particle files of every format contain it.
struct ParticleArray {
  enum class Type : std::uint8_t { real, whole, flag };

  std::string_view name;
  std::string_view unit;       // in 2D per metre of depth; empty if dimensionless
  std::vector<double> values;  // particle after particle
  Type type = Type::real;
  std::span<const std::string_view> components{};  // "x", "y", "z" or "xx", "yy" ...; empty for a scalar

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// Order of VTK for a symmetric tensor with six components.
std::span<const std::string_view> tensor_components();

/// Fields in the given order, then diameter, velocity, body, material, held, id, mass, volume, initial position,
/// displacement. The stress tensor (Cauchy, positive in tension) follows if `fields` contain one of its components,
/// the strain tensor (logarithmic, ½ ln F Fᵀ) likewise. Vectors have three components also in 2D.
std::vector<ParticleArray> particle_arrays(const Snapshot& now, std::span<const Field* const> fields);

/// Positions, three components each, m.
ParticleArray position_array(const Snapshot& now);

}  // namespace taut::cli
