#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

/// `vtp` is for ParaView and taut, `xyz` (extended) for OVITO and ASE.
enum class ParticleFormat : std::uint8_t { vtp, xyz, csv };

/// In enumerator order, also file extensions.
inline constexpr std::array<std::string_view, 3> particle_formats{"vtp", "xyz", "csv"};

constexpr std::string_view name(ParticleFormat format) {
  return particle_formats[static_cast<std::size_t>(format)];
}

struct ParticleForm {
  ParticleFormat format = ParticleFormat::vtp;
  bool single_precision = false;  // of real numbers

  bool operator==(const ParticleForm&) const = default;
};

std::string particle_text(const Snapshot& snapshot, std::span<const Field* const> fields, ParticleForm form);

}  // namespace taut::cli
