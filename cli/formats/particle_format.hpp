#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

/// vtp: for ParaView and for taut itself. xyz: extended XYZ for OVITO and ASE. csv: for spreadsheets.
enum class ParticleFormat : std::uint8_t { vtp, xyz, csv };

/// Names in the order of ParticleFormat, also extensions of the files.
inline constexpr std::array<std::string_view, 3> particle_formats{"vtp", "xyz", "csv"};

constexpr std::string_view name(ParticleFormat format) {
  return particle_formats[static_cast<std::size_t>(format)];
}

struct ParticleForm {
  ParticleFormat format = ParticleFormat::vtp;
  bool single_precision = false;  // real numbers as Float32 (vtp) or with the digits of a float (xyz, csv)

  bool operator==(const ParticleForm&) const = default;
};

/// Content of a particle file with the arrays of particle_arrays().
std::string particle_text(const Snapshot& snapshot, std::span<const Field* const> fields, ParticleForm form);

}  // namespace taut::cli
