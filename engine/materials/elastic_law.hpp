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

/// The laws that a user may choose in place of the published one, among those with a LawRow::choice.
enum class OtherLaws : std::uint8_t { none, all, with_volume_ratio };

/// The switches of every method on the initial configuration.
struct ElasticSwitches {
  Law law = Law::neo_hookean;  // the published one
  OtherLaws others = OtherLaws::none;
};

}  // namespace taut
