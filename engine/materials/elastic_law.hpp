#pragma once

#include <cstdint>

namespace taut {

enum class Law : std::uint8_t {
  none,
  neo_hookean,
  mooney_rivlin,
  st_venant_kirchhoff,
  linear_elastic,
  rotated_piola,
};

/// Whether the law permits the volume ratio and the cofactor of F as unknowns.
constexpr bool takes_volume_ratio(Law law) { return law == Law::neo_hookean || law == Law::mooney_rivlin; }

/// Laws that users may choose instead of the method's own.
enum class OtherLaws : std::uint8_t { none, all, with_volume_ratio };

struct ElasticSwitches {
  Law law = Law::neo_hookean;
  OtherLaws others = OtherLaws::none;
};

}  // namespace taut
