#pragma once

#include <cstdint>

namespace taut {

/// What gives the stress for the deformation gradient; engine/materials/.
enum class Law : std::uint8_t {
  none,
  neo_hookean,
  mooney_rivlin,
  st_venant_kirchhoff,
  linear_elastic,
  rotated_piola,
};

/// Volume ratio and cofactor of F may be unknowns of their own; the other laws take them from F.
constexpr bool takes_volume_ratio(Law law) { return law == Law::neo_hookean || law == Law::mooney_rivlin; }

}  // namespace taut
